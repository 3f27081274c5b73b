// Cameras for tests: made from a node as a render makes them.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "nodes/common/node_test_support.h"
#include "scene/camera.h"

namespace lightsieve {

inline std::unique_ptr<Camera> make(const TestNode& node, TestContext& context) {
    return node.type().make_camera(node.block(), context);
}
/// The same for a node with which nothing is wrong.
inline std::unique_ptr<Camera> make(const TestNode& node) {
    TestContext context;
    auto camera = make(node, context);
    EXPECT_EQ(context.diagnostics().items().size(), 0U) << context.diagnostics().render();
    return camera;
}
inline void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-5F) {
    EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

}  // namespace lightsieve
