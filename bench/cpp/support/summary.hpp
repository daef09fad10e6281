#pragma once
/// The table of ratios.

#include "support/figure.hpp"

namespace bench {

/// Times ours and baseline of every piece back to back, `rounds` times over, so that whatever else the machine does
/// falls on both alike.
Times paired_times(const Figure& figure, int rounds);

/// Measures and prints all figures as a Markdown table.
void print_summary(const Figures& figures, int rounds);

}  // namespace bench
