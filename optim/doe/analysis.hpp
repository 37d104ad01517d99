#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "optim/doe/confidence.hpp"

/// What a table of samples says about the factors. `samples` has a row for each sample and a column for each
/// factor, in the factors' units and all finite; `responses` has one number for each row, and a sample that
/// failed, or has no such response, has one there that is not finite (NaN). Such a row is left out of every
/// figure that depends on it, and counted. All functions are pure: same arguments, same bits.
namespace kinetix::optim {

using SampleMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// @name Main effects: any table of samples
/// @{

/// The rows where one factor has about one value.
struct EffectLevel {
  double lower, upper;  ///< least and greatest value of the factor in these rows, usable or not, in its unit
  double mean;          ///< of the response, in its unit; NaN without usable rows
  /// Of the mean: sd / sqrt(used), in its unit; NaN below two usable rows, and where rows are related.
  double standard_error;
  std::int64_t used, failed;  ///< rows
};

struct MainEffect {
  std::vector<EffectLevel> levels;  ///< by increasing value of the factor
  bool binned = false;              ///< levels are bins of about as many rows each, not single values
  /// Share of the response's variance that goes with the level: an estimate of Sobol's first-order index from
  /// any table whose rows are independent. The correlation ratio without its bias, (S_b - (k - 1) s^2) / S_t
  /// with S_b and S_t the sums of squares between levels and in all, s^2 the variance within, k the levels
  /// (Kelley, Proc. Natl. Acad. Sci. 21, 554, 1935); may fall a little below 0. Of a grid S_b / S_t, the index itself:
  /// means of its levels hold nothing of the other factors; by all its levels, also where these are binned. NaN for a
  /// constant response, where there are no more usable rows than levels, and where rows are related.
  double variance_share = 0;
  /// The interval that holds it in about 95 of 100 tables, within 0 and 1: by the shares of the tables that lack one row
  /// (jackknife). NaN of a grid, which has no chance in it, and where variance_share is.
  double share_lower = 0, share_upper = 0;
};

/// How the rows of a table hang together.
enum class TableRows {
  independent,  ///< lhs, sobol, monte_carlo
  grid,         ///< factorial: every combination of the levels once
  related  ///< saltelli, morris: many rows differ in one factor alone, so that their number says too much
};

struct MainEffectOptions {
  int most_values = 12;  ///< 1 or more: a factor of more values than this is binned
  int bins = 10;         ///< 1 or more; of as many rows each as equal values in one bin allow
  TableRows rows = TableRows::independent;

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// The mean response level by level of each factor, all else left to vary.
/// @throws InvalidInput for sizes that do not fit, a factor value that is not finite, options that do not
/// validate
std::vector<MainEffect> main_effects(const SampleMatrix& samples, std::span<const double> responses,
                                     const MainEffectOptions& options = {});

/// As main_effects for a table of SamplingMethod::one_at_a_time (row 0 the base): of each factor, the base
/// and the rows where it alone differs from the base, one level for each value. variance_share is NaN: such a
/// table has none. @throws InvalidInput as main_effects, without rows, and for a row that differs in more
/// than one factor
std::vector<MainEffect> one_at_a_time_effects(const SampleMatrix& samples, std::span<const double> responses);

/// @}
/// @name Correlation and linear regression: any table of independent samples
/// @{

/// NaN for a factor that does not vary over the usable rows (the plane is then that of the others), and for a
/// response that does not.
struct LinearEffect {
  double correlation;       ///< Pearson's, -1 to 1
  double rank_correlation;  ///< Spearman's, equal values sharing their mean rank; -1 to 1
  double slope;             ///< of the least-squares plane, response per unit of the factor, all others held
  double slope_error;       ///< its standard error, response per unit of the factor
  double standardised;      ///< slope * sd of the factor / sd of the response, dimensionless
};

struct LinearModel {
  std::vector<LinearEffect> factors;
  /// Share of the variance that the plane explains, 0 to 1. It, the slopes and what follows from them are NaN
  /// where the usable rows are not more than varying factors + 1, or these depend on each other linearly.
  double r_squared;
  std::int64_t used, failed;  ///< rows
};

/// @throws InvalidInput as main_effects
LinearModel linear_effects(const SampleMatrix& samples, std::span<const double> responses);

/// Share of the response's variance that goes with a family of factors together, in proportion to each: of as many
/// as one likes, even more than rows. The sum of the squared correlations, each less the 1 / (n - 1) that it
/// has by chance, right within 3 / n in the mean; factors must be independent. Its interval holds it in 95 of 100 tables or more, and is cut to 0 to 1;
/// the value itself may fall a little below 0. NaN below three usable rows, and where no factor varies.
/// @param correlations of the factors with the response; those that are not finite do not count   @param used rows
Estimate linear_share(std::span<const double> correlations, std::int64_t used);

/// @}
/// @name Sobol's indices: tables of SamplingMethod::saltelli
/// @{

/// Shares of the response's variance.
struct SobolIndex {
  /// Of the factor by itself: mean of f(B) (f(A with factor of B) - f(A)) over the variance (Saltelli et al.,
  /// Comput. Phys. Commun. 181, 259, 2010, table 2 (b)); f less its mean, which changes no expectation.
  Estimate first;
  /// Of the factor with all its interactions: mean of (f(A) - f(A with factor of B))^2 / 2 over the variance
  /// (Jansen, Comput. Phys. Commun. 117, 35, 1999; table 2 (f) there).
  Estimate total;
  std::int64_t used_first, used_total;  ///< bases whose rows that the index needs are all usable
};

/// All indices are NaN for a constant response, and one that has fewer than two usable bases is. Estimates
/// may fall a little below 0 or above 1. The bootstrap draws bases as if independent, which points of Sobol's
/// sequence are better than: intervals err on the wide side.
struct SobolIndices {
  std::vector<SobolIndex> factors;
  /// Of the response: mean over the usable rows A and B, variance over the bases where both are usable; in
  /// the response's unit, and that squared.
  double mean, variance;
  std::int64_t bases, failed;  ///< bases; rows that failed
};

/// @param responses of a table of SamplingMethod::saltelli in its order, a multiple of factors + 2
/// @throws InvalidInput for another number of responses, no factors, options that do not validate
SobolIndices sobol_indices(std::span<const double> responses, int factors,
                           const ConfidenceOptions& options = {});

/// @}
/// @name Elementary effects: tables of SamplingMethod::morris
/// @{

/// Of one factor's elementary effects: change of the response over change of the factor, times the factor's
/// span, greatest less least value in the table. So effects are in the response's unit and comparable over
/// factors. Exact for a linear response: mu = slope * span, sigma = 0.
struct MorrisEffect {
  Estimate mu;       ///< mean: direction and size (Morris, Technometrics 33, 161, 1991)
  Estimate mu_star;  ///< mean of the absolute effects: size (Campolongo, Cariboni, Saltelli, Environ. Model.
                     ///< Softw. 22, 1509, 2007)
  Estimate sigma;    ///< standard deviation: curvature and interaction; NaN below two effects
  std::int64_t used, dropped;  ///< effects; dropped for a failed row at one of their ends
};

/// @param samples table of SamplingMethod::morris in its order, a multiple of factors + 1 rows
/// @throws InvalidInput as main_effects, and for a table that is no such one: a step in which not exactly one
/// factor changes, or a factor that a trajectory moves twice
std::vector<MorrisEffect> morris_effects(const SampleMatrix& samples, std::span<const double> responses,
                                         const ConfidenceOptions& options = {});

/// @}

}  // namespace kinetix::optim
