// Whole experiments that show whether each lobe's light reaches the right AOV, each with one verdict.
//
// They are functions and not tests because they serve twice: the tests expect good verdicts, and the test of the tests
// injects faults and expects a bad verdict from at least one. Together they take a few seconds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/testing/checks.h"

namespace lightsieve::testing {

/// Five overlapping lobes under an area light: each AOV against integration of its lobe alone.
[[nodiscard]] Verdict check_lobes_under_a_quad();
/// The same under a dome that is brighter on one side.
[[nodiscard]] Verdict check_lobes_under_a_dome();
/// Lobes on both sides of a surface between two lights.
[[nodiscard]] Verdict check_lobes_on_both_sides();
/// One bounce: the light comes from a diffuse wall.
[[nodiscard]] Verdict check_lobes_through_one_bounce();
/// Diffuse and specular depth differ: one direction belongs to both lobes, but only one may go on.
[[nodiscard]] Verdict check_depth_limits_by_lobe();
/// A wall that only some ray types see: likewise.
[[nodiscard]] Verdict check_masks_by_lobe();
/// A light whose multipliers differ for diffuse and specular: likewise.
[[nodiscard]] Verdict check_multipliers_by_lobe();
/// Coat alone, glass alone, ...: all light in one AOV, exactly none in the others.
[[nodiscard]] Verdict check_single_lobes();
/// Lights met by rays are light, not emission: a convex object without bounces has no indirect light.
[[nodiscard]] Verdict check_direct_light_is_direct();
/// The additive sets on a scene with every lobe.
[[nodiscard]] Verdict check_additive_sets();
/// The path log of a scene with every lobe.
[[nodiscard]] Verdict check_path_log();

struct NamedCheck {
    std::string name;
    std::function<Verdict()> run;
};
/// All of the above.
[[nodiscard]] std::vector<NamedCheck> lobe_checks();

}  // namespace lightsieve::testing
