// Laws that rendered AOVs must obey, as functions with a verdict.
//
// Each check says whether a picture (or a scene) obeys one law and, if not, where it breaks. Tests expect good verdicts;
// the test of the tests (testing/mutants) renders with a fault injected and expects a bad one from at least one of them.
//
// Tolerances: layers that add up are sums of the same numbers in another order, rounded to float once each, so that 1e-5
// of the layers' magnitudes is loose by a factor of about 20. Statistical checks compare means with standard errors that
// are estimated from pixels, which are independent (each has a scrambled sequence of its own); their limit is kZ standard
// errors, exceeded by chance once in 1.5e5 comparisons. Seeds are fixed: a check that passed once passes always.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "core/event.h"
#include "render/path_log.h"
#include "render/testing/test_scene.h"

namespace lightsieve::testing {

inline constexpr double kSumTolerance = 1e-5;
/// Limit of statistical checks, in standard errors. Two-sided normal tail beyond it: 6.8e-6.
inline constexpr double kZ = 4.5;

struct Verdict {
    bool good = true;
    std::string why;  ///< the first and worst offence; empty if good
    explicit operator bool() const { return good; }
    /// So that EXPECT_TRUE says why.
    operator ::testing::AssertionResult() const {
        return good ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << why;
    }
};

/// Mean over all pixels of a channel, and the standard error of that mean.
struct Estimate {
    double mean = 0, error = 0;
};
[[nodiscard]] Estimate estimate(const Picture& picture, const std::string& layer, int channel);

/// The parts add up to the whole in every pixel and channel.
[[nodiscard]] Verdict check_sum(const Picture& picture, const std::string& whole,
                                const std::vector<std::string>& parts,
                                double tolerance = kSumTolerance);
/// Exactly 0 everywhere.
[[nodiscard]] Verdict check_black(const Picture& picture, const std::string& layer);
/// Some light in it; a law about nothing but zeros proves nothing.
[[nodiscard]] Verdict check_lit(const Picture& picture, const std::string& layer);
/// Two layers are equal within `tolerance` of their magnitudes in every pixel.
[[nodiscard]] Verdict check_equal(const Picture& a, const std::string& layer_a, const Picture& b,
                                  const std::string& layer_b, double tolerance = kSumTolerance);
/// Two layers are the same bits.
[[nodiscard]] Verdict check_identical(const Picture& a, const std::string& layer_a,
                                      const Picture& b, const std::string& layer_b);

/// The mean over all pixels is `truth`, where pixels are independent estimates of it.
///
/// relative_slack  error that the truth itself may have
[[nodiscard]] Verdict check_mean(const Picture& picture, const std::string& layer, Color truth,
                                 double relative_slack = 0);
/// The means of two layers of different renders agree statistically. Every pixel of a layer must estimate the same value
/// or the pictures must show the same (pixels are then compared in pairs).
[[nodiscard]] Verdict check_same_mean(const Picture& a, const std::string& layer_a,
                                      const Picture& b, const std::string& layer_b);
/// Independent estimates whose mean should be `truth`.
[[nodiscard]] Verdict check_mean_of(const std::vector<double>& values, double truth,
                                    const std::string& what, double relative_slack = 0);
/// Every pixel is `truth` within a fraction of it.
[[nodiscard]] Verdict check_constant(const Picture& picture, const std::string& layer, Color truth,
                                     double relative);

/// Every expression layer and the beauty equal the sum of the logged paths that a naive matcher gives them.
///
/// For scenes with one camera, one filter without negative lobes, and AOVs that no term reduction touches.
[[nodiscard]] Verdict check_oracle(const Scene& scene, const Picture& picture,
                                   std::span<const LoggedPath> paths,
                                   double tolerance = kSumTolerance);

}  // namespace lightsieve::testing
