#pragma once
/// One run of the optimizer from one start, recorded.

#include "ninedof/optimize/optimize.hpp"

namespace ninedof {

/// Which objective a single run minimizes.
enum class Formulation {
  minimax,  ///< the smooth problem of optimize.hpp
  plain,    ///< the logarithm of the index itself, as in the paper's SQP run: it stops early at kinks
};

/// The best feasible objective after each evaluation (infinite before the first), and the end point.
struct Trace {
  std::vector<double> best;
  Candidate end;
};

/// Throws Stopped.
Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation = Formulation::minimax,
            const Settings& settings = {}, const std::stop_token& stop = {});

}  // namespace ninedof
