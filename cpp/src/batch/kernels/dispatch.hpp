#pragma once
/// Selects the kernels for the instruction set of this processor.

#include <string>

#include "batch/kernels/table.hpp"

namespace ninedof::kernels {

/// The table of a level of x86-64, "base", "v2", "v3" or "v4"; null if this build or this processor does not have it.
const Table* table_of(const std::string& level);

/// The best table for this processor, or that named by the environment variable NINEDOF_SIMD;
/// throws InvalidArgument for an unknown name.
const Table& table();

}  // namespace ninedof::kernels
