// Shows a picture in a viewer while it is rendered: finished buckets, as they come.
//
// A thread of its own sends them, so that rendering never waits: what the viewer does not take in time waits in memory, up to
// a bound, and is left out beyond it. Nothing that happens to the viewer ends a render; it is told in warnings.
// Viewers take colours for linear Rec. 709, so that is what they get, whatever the rendering space.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/color.h"
#include "io/tev_client.h"
#include "render/render.h"

namespace lightsieve {

class LiveView {
  public:
    /// Connects and shows an empty picture; says with a warning if that is impossible.
    ///
    /// address    HOST:PORT
    /// name       of the picture
    /// region     of the frame, which is the picture
    /// layers     what is shown; all of one picture
    /// rendering  space of the layers' colours
    /// most_waiting  of what the viewer has not taken yet [bytes]
    /// throws  InputError (invalid-value): the address is none
    LiveView(const std::string& address, const std::string& name, const Region& region,
             std::vector<ImageLayer> layers, const ColorSpace& rendering, Diagnostics& diagnostics,
             std::size_t most_waiting = std::size_t{256} << 20);
    /// As `finish`.
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    /// Shows a rectangle. values: by layer, as drivers get them. Returns at once.
    void show(int x, int y, int width, int height, std::span<const std::span<const float>> values);
    /// Gives the viewer a moment for what waits, and says what went wrong.
    void finish();

  private:
    void send_all();
    [[nodiscard]] double patience_s();

    std::string name_;
    std::size_t most_waiting_;
    Region region_;
    std::vector<ImageLayer> layers_;
    ColorConversion conversion_;
    std::vector<std::string> channels_;
    Diagnostics& diagnostics_;
    std::optional<TevConnection> connection_;
    std::thread sender_;
    std::mutex mutex_;  ///< guards what follows
    std::condition_variable changed_;
    std::deque<std::vector<std::byte>> waiting_;
    std::size_t waiting_bytes_ = 0, n_left_out_ = 0;
    bool closing_ = false;
    std::chrono::steady_clock::time_point closing_since_;
    std::optional<InputError> problem_;  ///< that ended the sending
};

}  // namespace lightsieve
