/// prove_optimum and the checker of certificates.

#include "ninedof/proof/optimum.hpp"

#include <chrono>
#include <cmath>

#include "ninedof/proof/checker.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

struct InterruptibleProof : OptimumProof {
  bool interrupted = false;
};

}  // namespace

void bind_optimum(py::module_& m) {
  using Proof = InterruptibleProof;
  py::class_<Proof>(m, "OptimumProof", "A proved lower bound of the condition number; the public class says more.")
      .def_readonly("lower_bound", &Proof::lower_bound,
                    "Of the condition number of every design; the target if complete.")
      .def_readonly("complete", &Proof::complete, "Whether the target is proved.")
      .def_readonly("boxes", &Proof::boxes, "Examined.")
      .def_readonly("open", &Proof::open, "Boxes for which less than the target is proved.")
      .def_property_readonly(
          "better", [](const Proof& p) { return std::isfinite(p.better) ? std::optional(p.better) : std::nullopt; },
          "A condition number below the target that a design of the domain has, or None.")
      .def_readonly("seconds", &Proof::seconds, "Wall time.")
      .def_readonly("interrupted", &Proof::interrupted, "By Ctrl-C.")
      .def_property_readonly(
          "left_out", [](const Proof& p) { return py::tuple(py::cast(p.left_out)); },
          "Limits of the study that the proof does not use.")
      .def_property_readonly(
          "certificate", [](const Proof& p) { return py::bytes(p.certificate); },
          "Bytes of a file for the checker; empty unless the tree was kept.");
  request<OptimumSettings>(m, "OptimumSettings", "What is to be proved, and when the search ends.")
      .def_readwrite("target", &OptimumSettings::target, "No condition number below it.")
      .def_readwrite("threads", &OptimumSettings::threads, "0: one for each processor.")
      .def_readwrite("box_limit", &OptimumSettings::box_limit, "Boxes examined, at most.")
      .def_readwrite("time_limit", &OptimumSettings::time_limit, "Seconds; 0 for none.")
      .def_readwrite("keep_tree", &OptimumSettings::keep_tree, "For a certificate.");
  m.def("prove_optimum", [](const Problem& study, const OptimumSettings& settings, const py::object& progress) {
    return interruptible(
        progress, [&](const Control& control) { return Proof{prove_optimum(study, settings, control)}; },
        [](Proof& found) { return found.interrupted = true; });
  });
  py::class_<checker::Verdict>(m, "Verdict", "What the checker of a certificate says.")
      .def_readonly("proved", &checker::Verdict::proved, "Whether the certificate proves what it says.")
      .def_readonly("incomplete", &checker::Verdict::incomplete,
                    "Whether all is right as far as it could be confirmed, and not all of it could.")
      .def_readonly("words", &checker::Verdict::words, "What is proved, or why the certificate is refused.")
      .def_readonly("boxes", &checker::Verdict::leaves, "Looked at.")
      .def_readonly("recut", &checker::Verdict::recut, "Of them, those that were divided further.")
      .def_property_readonly("study", tuple_of(&checker::Verdict::study),
                             "The designs or the robot that the proof is about, lines of text.");
  m.def(
      "check_certificate",
      [](std::string_view certificate, const py::object& progress, double seconds) {
        using Clock = std::chrono::steady_clock;
        struct TimeIsOver {};
        const auto begin = Clock::now();
        return interruptible(progress, [&](const Control& control) {
          try {
            return checker::check(certificate, [&](std::size_t done, std::size_t total) {
              if (control.stop.stop_requested()) throw Stopped{};
              if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds) throw TimeIsOver{};
              control.progress(static_cast<long>(done), static_cast<long>(total), std::nan(""));
            });
          } catch (const TimeIsOver&) {
            checker::Verdict out;
            out.incomplete = true;
            out.words = "not checked to its end, as the time is over: nothing wrong was found, and nothing is proved";
            return out;
          }
        });
      },
      py::arg("certificate"), py::arg("progress"), py::arg("seconds") = HUGE_VAL);
}

}  // namespace ninedof::python
