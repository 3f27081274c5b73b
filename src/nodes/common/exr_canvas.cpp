#include "nodes/common/exr_canvas.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace lightsieve {

ExrCanvas::ExrCanvas(ExrWriteSpec spec) : spec_(std::move(spec)) {
    const std::size_t n =
        static_cast<std::size_t>(spec_.data_width) * static_cast<std::size_t>(spec_.data_height);
    for (const ExrPart& part : spec_.parts)
        for (std::size_t c = 0; c < part.channels.size(); ++c)
            channels_.emplace_back(n, 0.0F);
}

void ExrCanvas::write(int x, int y, int width, int height, std::span<const ExrPlane> planes) {
    for (std::size_t c = 0; c < channels_.size(); ++c)
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                const int to_x = x + column - spec_.data_x, to_y = y + row - spec_.data_y;
                if (to_x < 0 || to_y < 0 || to_x >= spec_.data_width || to_y >= spec_.data_height)
                    continue;
                channels_[c][static_cast<std::size_t>(to_y) *
                                 static_cast<std::size_t>(spec_.data_width) +
                             static_cast<std::size_t>(to_x)] =
                    planes[c].data[row * planes[c].row_stride + column * planes[c].pixel_stride];
            }
}

bool ExrCanvas::is_empty(int x, int y) const {
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(spec_.data_width) +
        static_cast<std::size_t>(x);
    // By bits, for integers travel as floats: -0 is something, but nothing writes it where nothing is.
    return std::all_of(channels_.begin(), channels_.end(), [&](const std::vector<float>& channel) {
        return std::bit_cast<std::uint32_t>(channel[at]) == 0;
    });
}

auto ExrCanvas::filled() const -> Box {
    Box box{spec_.data_width, spec_.data_height, 0, 0};
    for (int y = 0; y < spec_.data_height; ++y)
        for (int x = 0; x < spec_.data_width; ++x) {
            if (is_empty(x, y)) continue;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                   std::max(box.y1, y + 1)};
        }
    return box.x0 < box.x1 ? box : Box{0, 0, 1, 1};
}

void ExrCanvas::save(const std::string& path) {
    const Box box = filled();
    ExrWriteSpec cropped = spec_;
    cropped.data_x += box.x0;
    cropped.data_y += box.y0;
    cropped.data_width = box.x1 - box.x0;
    cropped.data_height = box.y1 - box.y0;
    std::vector<ExrPlane> planes;
    for (const std::vector<float>& channel : channels_)
        planes.push_back(
            {channel.data() + static_cast<std::ptrdiff_t>(box.y0) * spec_.data_width + box.x0, 1,
             spec_.data_width});
    ExrWriter writer(path, cropped);
    writer.write(cropped.data_x, cropped.data_y, cropped.data_width, cropped.data_height, planes);
    writer.close();
}

}  // namespace lightsieve
