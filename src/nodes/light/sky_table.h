// Directions drawn by how bright the sky is: a table over longitude and latitude, and one over what is brighter than the mean.
//
// Cells are even in longitude and within a row even in the sine of the latitude, so that directions are even over a
// cell's solid angle. Every cell keeps a share of the mean, so that no direction from which light may come has density
// 0: what lies between the points that were looked at costs variance, never light. Cells that hold more than a
// thousandth of all light are looked at more closely and get a table of their own: the sun is smaller than a cell.
//
// The second table leaves the light up to the mean to somebody who draws it better, such as by the cosine to a surface.
// Source of the idea: Karlik et al. 2019, "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling".
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "core/parallel.h"
#include "core/sampling.h"
#include "core/vec.h"

namespace lightsieve {

class SkyTable {
  public:
    /// Brightness from a direction, mean over a footprint [parts of the horizon] around it; finite, >= 0.
    using Brightness = std::function<float(Vec3f direction, float footprint)>;
    /// Of the sky's light.
    enum class Part : std::uint8_t { All, AboveMean };

    SkyTable() = default;
    /// width  cells around the horizon, at least 2; `brightness` is called by several threads
    SkyTable(std::size_t width, const Brightness& brightness) : width_(width), height_(width / 2) {
        make_rows();
        std::vector<float> cells(width_ * height_);
        parallel_for(height_, 0, [&](std::size_t y) {
            for (std::size_t x = 0; x < width_; ++x)
                cells[y * width_ + x] = coarse(x, y, brightness);
        });
        measure(cells);
        refine(cells, brightness);
        fill(tables_[0], cells, 0);
        fill(tables_[1], cells, mean_);
    }

    [[nodiscard]] bool empty() const { return width_ == 0; }

    /// A direction; its density is that of `pdf`.
    [[nodiscard]] Vec3f sample(Part part, Vec2f u) const {
        const Distribution2D& table = tables_[static_cast<std::size_t>(part)];
        const Vec2f uv = table.sample(u).uv;
        Place at = place_of(uv);
        if (const Distribution2D* fine = fine_table(at.x, at.y)) {
            const Vec2f inside = fine->sample({std::min(at.inside.x, kOneMinusEpsilon),
                                               std::min(at.inside.y, kOneMinusEpsilon)})
                                     .uv;
            at.inside = inside;
        }
        return direction(at);
    }
    /// Density of a unit direction, per solid angle.
    [[nodiscard]] float pdf(Part part, Vec3f d) const {
        const Distribution2D& table = tables_[static_cast<std::size_t>(part)];
        const Place at = find(d);
        const Vec2f center{(static_cast<float>(at.x) + 0.5F) / static_cast<float>(width_),
                           (static_cast<float>(at.y) + 0.5F) / static_cast<float>(height_)};
        const float pdf = table.pdf(center) * density_[at.y];
        const Distribution2D* fine = fine_table(at.x, at.y);
        return fine == nullptr ? pdf : pdf * fine->pdf(at.inside);
    }
    /// How much of the light is none above the mean brightness, 0 to 1.
    [[nodiscard]] float even_share() const { return even_share_; }
    /// The largest irradiance of planes that face along the axes.
    [[nodiscard]] float irradiance() const { return irradiance_; }

  private:
    /// Part of the mean brightness that is added to every cell.
    static constexpr float kFloor = 0.02F;
    /// Part of all light that a cell holds to be looked at more closely, and then into how many rows and columns it is cut.
    static constexpr float kRefined = 1e-3F;
    static constexpr std::size_t kFine = 16;

    /// A cell, and where within it, [0,1]^2.
    struct Place {
        std::size_t x, y;
        Vec2f inside;
    };

    void fill(Distribution2D& table, const std::vector<float>& brightness, float above) const {
        std::vector<float> weights(brightness.size());
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < width_; ++x) {
                const float left = std::max(brightness[y * width_ + x] - above, 0.0F);
                weights[y * width_ + x] = (left + kFloor * mean_) * solid_angle_[y];
            }
        table = Distribution2D(weights, width_, height_);
    }

    void make_rows() {
        edges_.resize(height_ + 1);
        density_.resize(height_);
        solid_angle_.resize(height_);
        constexpr auto pi = static_cast<double>(kPi);
        const auto edge = [&](std::size_t y) {
            return -std::cos(pi * static_cast<double>(y) / static_cast<double>(height_));
        };
        for (std::size_t y = 0; y <= height_; ++y)
            edges_[y] = static_cast<float>(edge(y));
        for (std::size_t y = 0; y < height_; ++y) {
            const double angle = 2 * pi / static_cast<double>(width_) * (edge(y + 1) - edge(y));
            solid_angle_[y] = static_cast<float>(angle);
            density_[y] = static_cast<float>(
                1 / (angle * static_cast<double>(width_) * static_cast<double>(height_)));
        }
    }

    [[nodiscard]] Place place_of(Vec2f uv) const {
        const auto cell = [](float x, std::size_t n, float& inside) {
            const float scaled = std::max(0.0F, x) * static_cast<float>(n);
            const std::size_t i = std::min(static_cast<std::size_t>(scaled), n - 1);
            inside = scaled - static_cast<float>(i);
            return i;
        };
        Place out{};
        out.x = cell(uv.x, width_, out.inside.x);
        out.y = cell(uv.y, height_, out.inside.y);
        return out;
    }
    [[nodiscard]] Vec3f direction(const Place& at) const {
        const float sine =
            std::clamp(lerp(edges_[at.y], edges_[at.y + 1], at.inside.y), -1.0F, 1.0F);
        const float cosine = safe_sqrt(1 - sine * sine);
        const float longitude =
            2 * kPi * ((static_cast<float>(at.x) + at.inside.x) / static_cast<float>(width_));
        return {cosine * std::sin(longitude), sine, cosine * std::cos(longitude)};
    }
    [[nodiscard]] Place find(Vec3f d) const {
        const float sine = std::clamp(d.y, -1.0F, 1.0F);
        const float longitude = std::atan2(d.x, d.z) / (2 * kPi);
        Place at =
            place_of({longitude < 0 ? longitude + 1 : longitude, 0.5F + std::asin(sine) * kInvPi});
        // The row by angle, corrected where rounding puts it on the wrong side of an edge.
        if (sine < edges_[at.y] && at.y > 0) --at.y;
        if (sine >= edges_[at.y + 1] && at.y + 1 < height_) ++at.y;
        at.inside.y = std::clamp((sine - edges_[at.y]) / (edges_[at.y + 1] - edges_[at.y]), 0.0F,
                                 kOneMinusEpsilon);
        at.inside.x = std::clamp(at.inside.x, 0.0F, kOneMinusEpsilon);
        return at;
    }

    /// Mean over a cell, from 2 x 2 points with textures filtered to their distance.
    [[nodiscard]] float coarse(std::size_t x, std::size_t y, const Brightness& brightness) const {
        float sum = 0;
        for (const float dx : {0.25F, 0.75F})
            for (const float dy : {0.25F, 0.75F})
                sum += brightness(direction({x, y, {dx, dy}}), 0.5F / static_cast<float>(width_));
        return sum * 0.25F;
    }

    /// The mean brightness and the irradiance of planes that face along the axes.
    void measure(const std::vector<float>& cells) {
        std::array<double, 6> facing{};
        double sum = 0;
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < width_; ++x) {
                const double value = static_cast<double>(cells[y * width_ + x]) *
                                     static_cast<double>(solid_angle_[y]);
                const Vec3f d = direction({x, y, {0.5F, 0.5F}});
                sum += value;
                for (int axis = 0; axis < 3; ++axis)
                    facing[static_cast<std::size_t>(2 * axis + (d[axis] > 0 ? 0 : 1))] +=
                        value * static_cast<double>(std::abs(d[axis]));
            }
        mean_ = static_cast<float>(sum / (4 * static_cast<double>(kPi)));
        double even = 0;
        for (std::size_t i = 0; i < cells.size(); ++i)
            even += static_cast<double>(std::min(cells[i], mean_) * solid_angle_[i / width_]);
        even_share_ = sum > 0 ? static_cast<float>(even / sum) : 1;
        irradiance_ = static_cast<float>(*std::max_element(facing.begin(), facing.end()));
    }

    /// Looks more closely at bright cells: their tables, and their means in place of the coarse ones.
    void refine(std::vector<float>& cells, const Brightness& brightness) {
        const float least = kRefined * mean_ * 4 * kPi;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (cells[i] * solid_angle_[i / width_] > least)
                fine_cells_.push_back(static_cast<std::uint32_t>(i));
        fine_tables_.resize(fine_cells_.size());
        parallel_for(fine_cells_.size(), 0, [&](std::size_t k) {
            const std::size_t i = fine_cells_[k];
            std::vector<float> values = fine_values(i % width_, i / width_, brightness);
            const float mean = std::accumulate(values.begin(), values.end(), 0.0F) /
                               static_cast<float>(values.size());
            const float floor = kFloor * std::max(mean_, std::max(mean, cells[i]));
            for (float& value : values)
                value += floor;
            fine_tables_[k] = Distribution2D(values, kFine, kFine);
            // What the points found, and some trust in what the filtered ones did.
            cells[i] = mean + kFloor * cells[i];
        });
    }
    /// Brightness of the parts of a cell: the largest at the middles of a part and those around it, for a rim that runs
    /// through a part is bright on one side.
    [[nodiscard]] std::vector<float> fine_values(std::size_t x, std::size_t y,
                                                 const Brightness& brightness) const {
        constexpr std::size_t kSide = kFine + 2;
        std::array<float, kSide * kSide> points{};
        for (std::size_t v = 0; v < kSide; ++v)
            for (std::size_t u = 0; u < kSide; ++u)
                points[v * kSide + u] =
                    brightness(direction({x,
                                          y,
                                          {(static_cast<float>(u) - 0.5F) / kFine,
                                           (static_cast<float>(v) - 0.5F) / kFine}}),
                               0);
        std::vector<float> out(kFine * kFine);
        for (std::size_t v = 0; v < kFine; ++v)
            for (std::size_t u = 0; u < kFine; ++u)
                for (std::size_t n = 0; n < 9; ++n)
                    out[v * kFine + u] =
                        std::max(out[v * kFine + u], points[(v + n / 3) * kSide + u + n % 3]);
        return out;
    }
    [[nodiscard]] const Distribution2D* fine_table(std::size_t x, std::size_t y) const {
        const auto cell = static_cast<std::uint32_t>(y * width_ + x);
        const auto found = std::lower_bound(fine_cells_.begin(), fine_cells_.end(), cell);
        if (found == fine_cells_.end() || *found != cell) return nullptr;
        return &fine_tables_[static_cast<std::size_t>(found - fine_cells_.begin())];
    }

    std::size_t width_ = 0, height_ = 0;
    std::array<Distribution2D, 2> tables_;  ///< by Part
    std::vector<float> edges_;        ///< sine of the latitude at each row's lower edge, and 1
    std::vector<float> solid_angle_;  ///< of a cell of each row
    std::vector<float>
        density_;  ///< of each row: over the sphere for a density of 1 over the table
    std::vector<std::uint32_t> fine_cells_;  ///< cells with tables of their own, rising
    std::vector<Distribution2D> fine_tables_;
    float mean_ = 0, even_share_ = 1, irradiance_ = 0;
};

}  // namespace lightsieve
