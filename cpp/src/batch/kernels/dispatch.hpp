#pragma once
/// The kernels that fit this processor.

#include <string>

#include "batch/kernels/table.hpp"

namespace ninedof::kernels {

/// The table of a level of x86-64, "base", "v2", "v3" or "v4"; null where this build or this processor does not have it.
const Table* table_of(const std::string& level);

/// The best table for this processor, or the one that the environment variable NINEDOF_SIMD names. Throws InvalidArgument where
/// there is none of that name.
const Table& table();

}  // namespace ninedof::kernels
