#include "io/color_config.h"

#include <OpenColorIO/OpenColorIO.h>

#include <array>
#include <deque>
#include <filesystem>
#include <mutex>

namespace OCIO = OCIO_NAMESPACE;

namespace lightsieve {
namespace {

/// Names under which configurations have the space of 8-bit pictures, likeliest first.
constexpr std::array<const char*, 6> kIntegerSpaces{
    "sRGB - Texture",           "srgb_texture", "srgb_tx", "Input - Generic - sRGB - Texture",
    "Utility - sRGB - Texture", "sRGB"};

class OcioSpace final : public ExternalSpace {
  public:
    OcioSpace(std::string name, ColorSpace rendering, OCIO::ConstCPUProcessorRcPtr to,
              OCIO::ConstCPUProcessorRcPtr from)
        : ExternalSpace(std::move(name), rendering), to_(std::move(to)), from_(std::move(from)) {}
    [[nodiscard]] Color to_rendering(Color stored) const noexcept override {
        return apply(*to_, stored);
    }
    [[nodiscard]] Color from_rendering(Color light) const noexcept override {
        return apply(*from_, light);
    }

  private:
    static Color apply(const OCIO::CPUProcessor& processor, Color c) noexcept {
        std::array<float, 3> v{c.r, c.g, c.b};
        processor.applyRGB(v.data());
        return {v[0], v[1], v[2]};
    }
    OCIO::ConstCPUProcessorRcPtr to_, from_;
};

class OcioSpaces final : public ColorSpaces {
  public:
    OcioSpaces(OCIO::ConstConfigRcPtr config, std::string rendering, std::string integers)
        // Where a built-in space has to be mixed in, the two rendering spaces are taken for the same.
        : ColorSpaces(find_color_space(rendering).value_or(kRenderingSpace)),
          config_(std::move(config)),
          rendering_name_(std::move(rendering)) {
        if (!integers.empty()) integers_ = find(integers);
        for (const char* name : kIntegerSpaces)
            if (!integers_) integers_ = find(name);
    }

    [[nodiscard]] ColorSpace integers() const override {
        return integers_.value_or(ColorSpaces::integers());
    }
    [[nodiscard]] std::optional<ColorSpace> find(std::string_view name) const override {
        if (name.empty()) return kRawSpace;
        const OCIO::ConstColorSpaceRcPtr space = config_->getColorSpace(std::string(name).c_str());
        if (!space) return ColorSpaces::find(name);
        if (space->isData()) return kRawSpace;
        if (rendering_name_ == space->getName()) return rendering();
        return external(space->getName());
    }
    [[nodiscard]] std::vector<std::string> names() const override {
        std::vector<std::string> out;
        for (int i = 0; i < config_->getNumColorSpaces(); ++i)
            out.emplace_back(config_->getColorSpaceNameByIndex(i));
        for (int i = 0; i < config_->getNumRoles(); ++i)
            out.emplace_back(config_->getRoleName(i));
        return out;
    }

  private:
    /// A space of the configuration with its processors; nothing if the library cannot convert it.
    [[nodiscard]] std::optional<ColorSpace> external(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        for (const auto& known : spaces_)
            if (known->name() == name) return as_space(*known);
        try {
            const char* linear = rendering_name_.c_str();
            spaces_.push_back(std::make_unique<OcioSpace>(
                name, rendering(),
                config_->getProcessor(name.c_str(), linear)->getDefaultCPUProcessor(),
                config_->getProcessor(linear, name.c_str())->getDefaultCPUProcessor()));
        } catch (const OCIO::Exception&) {
            return std::nullopt;  // a file that the space needs is missing, say
        }
        return as_space(*spaces_.back());
    }
    static ColorSpace as_space(const ExternalSpace& space) {
        ColorSpace out;
        out.external = &space;
        return out;
    }

    OCIO::ConstConfigRcPtr config_;
    std::string rendering_name_;
    std::optional<ColorSpace> integers_;
    mutable std::mutex mutex_;
    mutable std::deque<std::unique_ptr<OcioSpace>> spaces_;
};

/// The space that light is computed in: as asked for, or by its role. Null with a report if there is none.
OCIO::ConstColorSpaceRcPtr rendering_space(const OCIO::Config& config,
                                           const ColorConfigOptions& options,
                                           Diagnostics& diagnostics) {
    if (!options.rendering_space.empty()) {
        const auto found = config.getColorSpace(options.rendering_space.c_str());
        if (found) return found;
        std::vector<std::string> names;
        for (int i = 0; i < config.getNumColorSpaces(); ++i)
            names.emplace_back(config.getColorSpaceNameByIndex(i));
        diagnostics.error(Code::UnknownColorSpace,
                          "the configuration \"" + options.path + "\" has no space \"" +
                              options.rendering_space + "\" to render in",
                          options.where_rendering, did_you_mean(options.rendering_space, names));
        return nullptr;
    }
    for (const char* role : {"rendering", OCIO::ROLE_SCENE_LINEAR, "ACEScg"})
        if (const auto found = config.getColorSpace(role)) return found;
    diagnostics.warning(Code::ColorConfig,
                        "the colour configuration \"" + options.path +
                            "\" does not say which space light is computed in",
                        options.where,
                        "give it the role scene_linear; the built-in spaces are used");
    return nullptr;
}

}  // namespace

std::shared_ptr<const ColorSpaces> read_color_config(const ColorConfigOptions& options,
                                                     Diagnostics& diagnostics) {
    std::error_code ignored;
    if (std::filesystem::exists(options.path, ignored) &&
        !std::filesystem::is_regular_file(options.path, ignored)) {
        diagnostics.warning(
            Code::ColorConfig, "the colour configuration \"" + options.path + "\" is not a file",
            options.where, "the built-in spaces are used: ACEScg, sRGB and their like");
        return nullptr;
    }
    try {
        // Not validated as a whole: a missing file of one space must not take the others away.
        const OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(options.path.c_str());
        const auto rendering = rendering_space(*config, options, diagnostics);
        if (!rendering) return nullptr;
        return std::make_shared<OcioSpaces>(config, rendering->getName(), options.integers);
    } catch (const OCIO::Exception& e) {
        diagnostics.warning(
            Code::ColorConfig,
            "the colour configuration \"" + options.path + "\" cannot be read: " + e.what(),
            options.where, "the built-in spaces are used: ACEScg, sRGB and their like");
        return nullptr;
    }
}

}  // namespace lightsieve
