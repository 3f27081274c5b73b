#include "render/majorants.h"

#include <algorithm>
#include <cmath>

namespace lightsieve {

MajorantGrid::MajorantGrid(const Box3f& box, std::array<int, 3> size)
    : box_(box),
      size_(size),
      cells_(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                 static_cast<std::size_t>(size[2]),
             0.0F) {}

Box3f MajorantGrid::cell(int x, int y, int z) const {
    const Vec3f extent = box_.size();
    const auto corner = [&](int i, int j, int k) {
        return box_.lower +
               Vec3f{extent.x * (static_cast<float>(i) / static_cast<float>(size_[0])),
                     extent.y * (static_cast<float>(j) / static_cast<float>(size_[1])),
                     extent.z * (static_cast<float>(k) / static_cast<float>(size_[2]))};
    };
    return {corner(x, y, z), corner(x + 1, y + 1, z + 1)};
}

MajorantWalk::MajorantWalk(const MajorantGrid& grid, Vec3f origin, Vec3f direction, float t0,
                           float t1)
    : grid_(&grid), t_(t0), t_end_(t0), t_last_(t1) {
    const Vec3f extent = grid.box().size(), lower = grid.box().lower;
    const Vec3f at = origin + direction * t0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const int n = grid.size()[a];
        const float width = extent[axis] / static_cast<float>(n);
        const float x = (at[axis] - lower[axis]) / width;
        cell_[a] = std::clamp(static_cast<int>(std::clamp(x, 0.0F, 1e6F)), 0, n - 1);
        step_[a] = direction[axis] < 0 ? -1 : 1;
        limit_[a] = direction[axis] < 0 ? -1 : n;
        if (direction[axis] == 0 || !(width > 0)) {
            next_crossing_[a] = delta_[a] = kInfinity;
            continue;
        }
        delta_[a] = width / std::abs(direction[axis]);
        const auto border = static_cast<float>(cell_[a] + (step_[a] > 0 ? 1 : 0));
        next_crossing_[a] = (lower[axis] + border * width - origin[axis]) / direction[axis];
    }
}

bool MajorantWalk::next() {
    if (grid_ == nullptr || t_end_ >= t_last_) return false;
    const auto nearest = [&] {
        return static_cast<std::size_t>(
            std::min_element(next_crossing_.begin(), next_crossing_.end()) -
            next_crossing_.begin());
    };
    if (started_) {
        const std::size_t axis = nearest();
        cell_[axis] += step_[axis];
        next_crossing_[axis] += delta_[axis];
        if (cell_[axis] == limit_[axis]) return false;
        t_ = t_end_;
    }
    started_ = true;
    t_end_ = std::clamp(next_crossing_[nearest()], t_, t_last_);
    majorant_ = grid_->at(cell_[0], cell_[1], cell_[2]);
    return true;
}

}  // namespace lightsieve
