#include "math/slsqp.hpp"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <new>

namespace ninedof {

std::string slsqp_version() {
  int major = 0, minor = 0, bugfix = 0;
  ::nlopt_version(&major, &minor, &bugfix);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(bugfix);
}

namespace {

constexpr double slsqp_slack = 1e-10;  // of a constraint

/// NLopt asks for objective and constraints one after the other at the same point; both are computed at once.
struct Session {
  const Nlp& nlp;
  nlopt_opt opt;
  Eigen::VectorXd at;
  Nlp::Values values;
  std::exception_ptr failure;

  /// Nothing may be thrown through NLopt's C frames: an exception is kept here until NLopt has returned.
  void update(const double* y) noexcept {
    try {
      const Eigen::Map<const Eigen::VectorXd> point(y, nlp.variables);
      if (at.size() == point.size() && at == point) return;
      // SLSQP's own arithmetic has failed, and this is no design. The last values are kept, and the run ends.
      if (!point.allFinite()) return void(nlopt_force_stop(opt));
      at = point;
      if (!nlp.evaluate(at, values)) nlopt_force_stop(opt);
    } catch (...) {
      failure = std::current_exception();
      nlopt_force_stop(opt);
    }
  }
};

double objective(unsigned, const double* y, double* gradient, void* data) {
  auto& s = *static_cast<Session*>(data);
  s.update(y);
  if (gradient != nullptr) Eigen::VectorXd::Map(gradient, s.nlp.variables) = s.values.f_gradient;
  return s.values.f;
}

void constraints(unsigned, double* result, unsigned, const double* y, double* gradient, void* data) {
  auto& s = *static_cast<Session*>(data);
  s.update(y);
  Eigen::VectorXd::Map(result, s.nlp.constraints) = s.values.c;
  if (gradient != nullptr) Nlp::RowMajor::Map(gradient, s.nlp.constraints, s.nlp.variables) = s.values.c_gradient;
}

}  // namespace

Eigen::VectorXd slsqp(const Nlp& nlp, const Eigen::VectorXd& start, const SlsqpSettings& settings) {
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> opt(
      nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(nlp.variables)), &nlopt_destroy);
  if (!opt) throw std::bad_alloc();
  Session session{nlp, opt.get(), {}, {}, {}};
  session.values.f_gradient.setZero(nlp.variables);
  session.values.c.setZero(nlp.constraints);
  session.values.c_gradient.setZero(nlp.constraints, nlp.variables);
  nlopt_set_lower_bounds(opt.get(), nlp.low.data());
  nlopt_set_upper_bounds(opt.get(), nlp.high.data());
  nlopt_set_min_objective(opt.get(), objective, &session);
  // With a tolerance of zero NLopt would return the start: iterates satisfy constraints up to rounding only.
  const Eigen::VectorXd slack = Eigen::VectorXd::Constant(nlp.constraints, slsqp_slack);
  if (nlp.constraints > 0)
    nlopt_add_inequality_mconstraint(opt.get(), static_cast<unsigned>(nlp.constraints), constraints, &session,
                                     slack.data());
  nlopt_set_ftol_rel(opt.get(), settings.tolerance);
  nlopt_set_xtol_rel(opt.get(), settings.tolerance);
  nlopt_set_maxeval(opt.get(), settings.max_evaluations);
  const Eigen::VectorXd inside = start.cwiseMax(nlp.low).cwiseMin(nlp.high);
  Eigen::VectorXd y = inside;
  double f = 0.0;
  nlopt_optimize(opt.get(), y.data(), &f);
  if (session.failure) std::rethrow_exception(session.failure);
  return y.allFinite() ? y : inside;
}

}  // namespace ninedof
