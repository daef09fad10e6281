#pragma once
/// A question about a workspace in a unit of length near its size: a power of two, so that nothing is rounded.

#include "ninedof/workspace/certified.hpp"

namespace ninedof::certified {

struct Question {
  Geometry geometry;
  WorkspaceDomain domain;
  InternalPointRule rule;
  WorkspaceCriteria criteria;
  Configuration home;
};

/// Home; as in a map the middle of the box, O by the rule, where none is given.
Configuration home_or_middle(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                             const WorkspaceCriteria& criteria, const std::optional<Configuration>& home);

/// The exponent of the unit in which the question is of size 1.
int exponent_of(const Question& question);

/// All lengths times two to the power given.
Question scaled(const Question& question, int exponent);

/// The result back in the unit of the question.
void scale_back(CertifiedWorkspace& found, int exponent);

}  // namespace ninedof::certified
