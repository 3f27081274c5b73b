// Imagers between the renderer and a driver.
#pragma once

#include <memory>
#include <vector>

#include "scene/driver.h"
#include "scene/imager.h"

namespace lightsieve {

/// Hands everything on to another driver, colours as the imagers make them. Deep pixels stay as they are.
class ImagingDriver final : public Driver {
  public:
    ImagingDriver(std::unique_ptr<Driver> driver, Imagers imagers);

    /// Whether some imager acts on a layer.
    [[nodiscard]] bool changes(const ImageLayer& layer) const;

    [[nodiscard]] OutputForecast forecast(const ImageHeader& header) const override;
    [[nodiscard]] bool deep() const override { return driver_->deep(); }
    void write_deep(const DeepBucket& bucket) override { driver_->write_deep(bucket); }
    [[nodiscard]] std::string path() const override { return driver_->path(); }
    [[nodiscard]] bool open(const ImageHeader& header, Diagnostics& diagnostics) override;
    void write(const Bucket& bucket) override;
    [[nodiscard]] bool close(Diagnostics& diagnostics) override {
        return driver_->close(diagnostics);
    }

  private:
    /// One layer whose colours change.
    struct Changed {
        std::size_t layer = 0, n_channels = 0;
        std::vector<const Imager*> imagers;
        std::vector<float> pixels;  ///< of the last bucket
    };

    std::unique_ptr<Driver> driver_;
    Imagers imagers_;
    std::vector<Changed> changed_;
};

}  // namespace lightsieve
