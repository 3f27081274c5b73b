#include "render/live_view.h"

#include <algorithm>
#include <utility>

namespace lightsieve {
namespace {

/// How long a viewer may take nothing: while there is something to render, and when all is done [s].
constexpr double kPatience = 10, kLastPatience = 2;
/// How long the end of a render waits for the viewer in all [s].
constexpr double kLongestFarewell = 10;

}  // namespace

LiveView::LiveView(const std::string& address, const std::string& name, const Region& region,
                   std::vector<ImageLayer> layers, const ColorSpace& rendering,
                   Diagnostics& diagnostics, std::size_t most_waiting)
    : name_(name),
      most_waiting_(most_waiting),
      region_(region),
      layers_(std::move(layers)),
      conversion_(rendering, {Primaries::Rec709, Transfer::Linear}),
      diagnostics_(diagnostics) {
    for (const ImageLayer& layer : layers_)
        for (std::string& channel : channel_names(layer, is_beauty(layer)))
            channels_.push_back(std::move(channel));
    const NetworkAddress where = parse_network_address(address);
    try {
        connection_.emplace(where);
    } catch (InputError& e) {
        Error why = e.errors()[0];
        why.hint += "; the render goes on without it";
        why.severity = Severity::Warning;
        diagnostics_.add(std::move(why));
        return;
    }
    waiting_.push_back(tev_create_image(name_, region_.x1 - region_.x0 + 1,
                                        region_.y1 - region_.y0 + 1, channels_));
    sender_ = std::thread([this] { send_all(); });
}

LiveView::~LiveView() { finish(); }

double LiveView::patience_s() {
    const std::lock_guard lock(mutex_);
    if (!closing_) return kPatience;
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - closing_since_;
    return std::clamp(kLongestFarewell - since.count(), 0.0, kLastPatience);
}

void LiveView::send_all() {
    for (;;) {
        std::vector<std::byte> packet;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            packet = std::move(waiting_.front());
            waiting_.pop_front();
            waiting_bytes_ -= std::min(waiting_bytes_, packet.size());
        }
        try {
            connection_->send(packet, [this] { return patience_s(); });
        } catch (const InputError& e) {
            const std::lock_guard lock(mutex_);
            problem_ = e;
            waiting_.clear();
            return;
        }
    }
}

void LiveView::show(int x, int y, int width, int height,
                    std::span<const std::span<const float>> values) {
    if (!connection_) return;
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                      stride = channels_.size();
    {
        const std::lock_guard lock(mutex_);
        if (problem_) return;
        if (waiting_bytes_ + n * stride * sizeof(float) > most_waiting_) {
            ++n_left_out_;
            return;
        }
    }
    std::vector<float> pixels(n * stride);
    std::size_t first = 0;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        const std::size_t channels = layers_[l].n_channels;
        const bool converts = layers_[l].is_color && channels >= 3 && !conversion_.identity();
        for (std::size_t i = 0; i < n; ++i) {
            float* out = &pixels[i * stride + first];
            std::copy_n(&values[l][i * channels], channels, out);
            if (!converts) continue;
            const Color c = conversion_({out[0], out[1], out[2]});
            for (int k = 0; k < 3; ++k)
                out[k] = c[k];
        }
        first += channels;
    }
    std::vector<std::byte> packet =
        tev_update_image(name_, x - region_.x0, y - region_.y0, width, height, channels_, pixels);
    const std::lock_guard lock(mutex_);
    waiting_bytes_ += packet.size();
    waiting_.push_back(std::move(packet));
    changed_.notify_one();
}

void LiveView::finish() {
    if (!sender_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
        closing_since_ = std::chrono::steady_clock::now();
        changed_.notify_one();
    }
    sender_.join();
    if (problem_) {
        Error why = problem_->errors()[0];
        why.severity = Severity::Warning;
        diagnostics_.add(std::move(why));
    } else if (n_left_out_ > 0) {
        diagnostics_.warning(
            Code::ViewerLost,
            "the viewer is slower than the render: " + std::to_string(n_left_out_) +
                " parts of the picture were not shown",
            {}, "show fewer layers, or open the file when it is done");
    }
}

}  // namespace lightsieve
