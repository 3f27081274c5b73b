#include "render/imaging.h"

#include <algorithm>
#include <utility>

namespace lightsieve {
namespace {

/// Numbers that are no colours (normals, depths, ids) are left alone.
bool is_color(const ImageLayer& layer) {
    return layer.is_color && !layer.exact && (layer.aov_type == "RGB" || layer.aov_type == "RGBA");
}

}  // namespace

ImagingDriver::ImagingDriver(std::unique_ptr<Driver> driver, Imagers imagers)
    : driver_(std::move(driver)), imagers_(std::move(imagers)) {}

bool ImagingDriver::changes(const ImageLayer& layer) const {
    return is_color(layer) && std::any_of(imagers_.begin(), imagers_.end(),
                                          [&](const auto& i) { return i->selects(layer); });
}

OutputForecast ImagingDriver::forecast(const ImageHeader& header) const {
    OutputForecast out = driver_->forecast(header);
    for (const ImageLayer& layer : header.layers)
        if (changes(layer))
            out.memory += static_cast<std::size_t>(header.bucket_size) *
                          static_cast<std::size_t>(header.bucket_size) * layer.n_channels *
                          sizeof(float);
    return out;
}

bool ImagingDriver::open(const ImageHeader& header, Diagnostics& diagnostics) {
    changed_.clear();
    for (std::size_t i = 0; i < header.layers.size(); ++i) {
        if (!changes(header.layers[i])) continue;
        Changed& changed = changed_.emplace_back();
        changed.layer = i;
        changed.n_channels = header.layers[i].n_channels;
        for (const auto& imager : imagers_)
            if (imager->selects(header.layers[i])) changed.imagers.push_back(imager.get());
    }
    return driver_->open(header, diagnostics);
}

void ImagingDriver::write(const Bucket& bucket) {
    Bucket out = bucket;
    for (Changed& changed : changed_) {
        const std::span<const float> before = bucket.layers[changed.layer];
        changed.pixels.assign(before.begin(), before.end());
        for (std::size_t p = 0; p + 2 < changed.pixels.size(); p += changed.n_channels) {
            float* pixel = changed.pixels.data() + p;
            Color color{pixel[0], pixel[1], pixel[2]};
            for (const Imager* imager : changed.imagers)
                color = imager->changed(color);
            for (int c = 0; c < 3; ++c)
                pixel[c] = color[c];
        }
        out.layers[changed.layer] = changed.pixels;
    }
    driver_->write(out);
}

}  // namespace lightsieve
