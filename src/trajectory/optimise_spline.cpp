// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "optimise_spline.hpp"

#include <nlopt.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kEnough = 1e-4;     // relative change of the cost at which it has converged
constexpr double kMostChange = 2.5;  // of a duration's logarithm: by a factor of 12

/// What NLopt calls back: counts, keeps the best, and holds exceptions until it has returned.
struct Search {
  explicit Search(SplineObjective& cost) : objective(cost) {}

  SplineObjective& objective;
  std::vector<double> best;
  double lowest = std::numeric_limits<double>::infinity();
  int evaluations = 0;
  std::exception_ptr failure;
  nlopt_opt optimiser = nullptr;
};

double evaluate(unsigned count, const double* variables, double* gradient, void* data) {
  Search& search = *static_cast<Search*>(data);
  ++search.evaluations;
  try {
    const std::size_t slots = gradient != nullptr ? count : 0;
    const double cost = search.objective({variables, count}, {gradient, slots});
    if (cost < search.lowest) {
      search.lowest = cost;
      search.best.assign(variables, variables + count);
    }
    return cost;
  } catch (const InputError&) {  // a step so wild that its spline has no minimum ends the search
  } catch (...) {
    search.failure = std::current_exception();
  }
  nlopt_force_stop(search.optimiser);
  return std::numeric_limits<double>::infinity();
}

struct Destroyer {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, Destroyer>;

/// Durations stay within a factor of what they were, so that no wild step of a line search makes
/// the spline's equations hopeless.
void set_bounds(nlopt_opt optimiser, const std::vector<double>& variables, std::size_t durations) {
  for (const double sign : {-1.0, 1.0}) {
    std::vector<double> bound(variables.size(), sign * HUGE_VAL);
    for (std::size_t i = variables.size() - durations; i < variables.size(); ++i)
      bound[i] = variables[i] + sign * kMostChange;
    (sign < 0.0 ? nlopt_set_lower_bounds : nlopt_set_upper_bounds)(optimiser, bound.data());
  }
}

}  // namespace

OptimisationResult optimise_spline(SpaceSpline spline, const SplineCostConfig& config,
                                   const DistanceField& field, int most_evaluations) {
  OptimisationResult result;
  const std::size_t segments = spline.durations.size();
  SplineObjective objective(std::move(spline), config, field);
  std::vector<double> variables = objective.variables();
  objective(variables, {});
  result.report.before = objective.terms();

  Search search(objective);
  search.best = variables;  // where no step of the search has a cost
  const Optimiser optimiser(nlopt_create(NLOPT_LD_LBFGS, static_cast<unsigned>(variables.size())));
  search.optimiser = optimiser.get();
  nlopt_set_min_objective(optimiser.get(), evaluate, &search);
  nlopt_set_ftol_rel(optimiser.get(), kEnough);
  nlopt_set_maxeval(optimiser.get(), most_evaluations);
  set_bounds(optimiser.get(), variables, segments);
  double cost = 0.0;
  const nlopt_result outcome = nlopt_optimize(optimiser.get(), variables.data(), &cost);
  if (search.failure) std::rethrow_exception(search.failure);

  objective(search.best, {});  // a failed line search may have ended elsewhere
  result.report.after = objective.terms();
  result.report.evaluations = search.evaluations;
  result.report.converged =
      outcome == NLOPT_FTOL_REACHED || outcome == NLOPT_XTOL_REACHED || outcome == NLOPT_SUCCESS;
  result.spline = objective.spline();
  return result;
}

}  // namespace ridgeway
