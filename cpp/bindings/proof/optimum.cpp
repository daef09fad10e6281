/// prove_optimum and the checker of certificates.

#include "ninedof/proof/optimum.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>

#include "ninedof/proof/checker.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

py::dict proved(const Problem& study, double target, int threads, long box_limit, double time_limit, bool keep_tree,
                const py::object& progress) {
  const OptimumSettings settings{target, threads, box_limit, time_limit, keep_tree};
  bool interrupted = false;
  const OptimumProof found = interruptible(
      progress, [&](const Control& control) { return prove_optimum(study, settings, control); },
      [&](const OptimumProof&) { return interrupted = true; });
  py::dict out;
  out["lower_bound"] = found.lower_bound;
  out["complete"] = found.complete;
  out["boxes"] = found.boxes;
  out["open"] = found.open;
  out["better"] = std::isfinite(found.better) ? py::object(py::float_(found.better)) : py::none();
  out["seconds"] = found.seconds;
  out["interrupted"] = interrupted;
  out["left_out"] = found.left_out;
  out["certificate"] = py::bytes(found.certificate);
  return out;
}

py::tuple checked(const std::string& certificate, const py::object& progress) {
  const checker::Verdict found = interruptible(progress, [&](const Control& control) {
    return checker::check(certificate, [&](std::size_t done, std::size_t total) {
      if (control.stop.stop_requested()) throw Stopped{};
      control.progress(static_cast<long>(done), static_cast<long>(total), std::nan(""));
    });
  });
  return py::make_tuple(found.proved, found.words, found.leaves, found.recut, found.study);
}

}  // namespace

void bind_optimum(py::module_& m) {
  m.def("prove_optimum", &proved);
  m.def("check_certificate", &checked);
}

}  // namespace ninedof::python
