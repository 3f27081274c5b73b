#include "io/photometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>

#include "core/error.h"

namespace lightsieve {
namespace {

[[noreturn]] void fail(Code code, std::string message, std::string hint) {
    throw InputError(Error{code, std::move(message), {}, std::move(hint), {}, Severity::Error});
}

[[noreturn]] void damaged(const std::string& name, const std::string& why) {
    fail(Code::FileFormat, "photometric file \"" + name + "\" cannot be used: " + why,
         "get the IES file (LM-63) from the luminaire's maker again");
}

/// The numbers of a text, separated by blanks or commas.
class Numbers {
  public:
    Numbers(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

    [[nodiscard]] float next(const char* what) {
        while (!rest_.empty() && separates(rest_.front()))
            rest_.remove_prefix(1);
        if (rest_.empty()) damaged(name_, std::string("it ends before its ") + what);
        // Signs that from_chars does not take.
        const std::string_view number =
            rest_.front() == '+' && rest_.size() > 1 ? rest_.substr(1) : rest_;
        float value = 0;
        const auto [end, error] =
            std::from_chars(number.data(), number.data() + number.size(), value);
        const auto used = static_cast<std::size_t>(end - rest_.data());
        if (error != std::errc{} || !std::isfinite(value) ||
            (used < rest_.size() && !separates(rest_[used])))
            damaged(name_, std::string("\"") + std::string(word()) + "\" stands for its " + what);
        rest_.remove_prefix(used);
        return value;
    }
    /// A count of things that the rest of the text must still hold.
    [[nodiscard]] std::size_t count(const char* what) {
        const float value = next(what);
        if (!(value >= 0) || value != std::floor(value) ||
            value > static_cast<float>(rest_.size()))
            damaged(name_, std::string("its ") + what + " is no sensible number");
        return static_cast<std::size_t>(value);
    }
    [[nodiscard]] std::vector<float> list(std::size_t n, const char* what) {
        if (n > rest_.size()) damaged(name_, std::string("it ends before its ") + what);
        std::vector<float> out(n);
        for (float& value : out)
            value = next(what);
        return out;
    }

  private:
    static bool separates(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\x1a';
    }
    [[nodiscard]] std::string_view word() const {
        constexpr std::size_t kShown = 20;
        std::size_t n = 0;
        while (n < std::min(kShown, rest_.size()) && !separates(rest_[n]))
            ++n;
        return rest_.substr(0, n);
    }

    std::string_view rest_;
    const std::string& name_;
};

/// What follows `TILT=`.
std::string_view after_tilt(std::string_view text, const std::string& name) {
    const std::size_t at = text.find("TILT=");
    if (at == std::string_view::npos) damaged(name, "it has no line that begins with TILT=");
    return text.substr(at + 5);
}

std::vector<float> rising(std::vector<float> angles, const std::string& name, const char* what) {
    if (!std::is_sorted(angles.begin(), angles.end()))
        damaged(name, std::string("its ") + what + " do not rise");
    return angles;
}

/// Place among sorted angles: cell and fraction. Clamped to them.
struct Cell {
    std::size_t low, high;
    float fraction;
};
Cell find_cell(std::span<const float> angles, float angle) {
    const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
    if (above == angles.begin()) return {0, 0, 0};
    if (above == angles.end()) return {angles.size() - 1, angles.size() - 1, 0};
    const auto high = static_cast<std::size_t>(above - angles.begin());
    return {high - 1, high, (angle - angles[high - 1]) / (angles[high] - angles[high - 1])};
}

}  // namespace

Photometry::Photometry(Type type, std::vector<float> vertical, std::vector<float> horizontal,
                       std::vector<float> candela)
    : type_(type),
      vertical_(std::move(vertical)),
      horizontal_(std::move(horizontal)),
      candela_(std::move(candela)) {
    LIGHTSIEVE_ASSERT(!vertical_.empty() && !horizontal_.empty() &&
                          candela_.size() == vertical_.size() * horizontal_.size(),
                      std::to_string(candela_.size()));
    peak_ = *std::max_element(candela_.begin(), candela_.end());
}

float Photometry::candela(Vec3f d) const noexcept {
    const auto degrees = [](float radians) { return radians * (180 / kPi); };
    const auto arc_sine = [&](float s) { return degrees(std::asin(std::clamp(s, -1.0F, 1.0F))); };
    switch (type_) {
        case Type::B: return at(degrees(std::atan2(d.y, d.z)), arc_sine(d.x));
        case Type::A: return at(arc_sine(d.y), degrees(std::atan2(d.x, d.z)));
        case Type::C: break;
    }
    const float around = degrees(std::atan2(d.y, d.x));
    return at(degrees(std::atan2(std::sqrt(d.x * d.x + d.y * d.y), d.z)),
              around < 0 ? around + 360 : around);
}

/// Brings a horizontal angle to where it was measured, by the luminaire's symmetry.
float Photometry::folded(float h) const noexcept {
    const float first = horizontal_.front(), last = horizontal_.back();
    if (type_ != Type::C) return first >= 0 ? std::abs(h) : h;
    if (first == 0 && last <= 90) {
        const float half = std::fmod(h, 180.0F);
        return half > 90 ? 180 - half : half;
    }
    if (first == 0 && last <= 180) return h > 180 ? 360 - h : h;
    // Measured on one side of the plane 90-270.
    if (first == 90 && last <= 270) {
        if (h < 90) return 180 - h;
        return h > 270 ? 540 - h : h;
    }
    return h < first ? h + 360 : h;
}

float Photometry::at(float v, float h) const noexcept {
    if (type_ != Type::C && vertical_.front() >= 0) v = std::abs(v);
    // A little room, so that what was measured at 90 degrees is there at 90 degrees.
    constexpr float kRoom = 1e-3F;
    if (v < vertical_.front() - kRoom || v > vertical_.back() + kRoom) return 0;
    const Cell row = find_cell(vertical_, v);
    const auto along = [&](std::size_t column) {
        const float* values = &candela_[column * vertical_.size()];
        return std::lerp(values[row.low], values[row.high], row.fraction);
    };
    if (horizontal_.size() == 1) return along(0);
    const float angle = folded(h);
    if (type_ != Type::C &&
        (angle < horizontal_.front() - kRoom || angle > horizontal_.back() + kRoom))
        return 0;
    // All around, but without the last angle, which is the first: interpolate across.
    const float last = horizontal_.back(), round = horizontal_.front() + 360;
    if (type_ == Type::C && angle > last && round > last)
        return std::lerp(along(horizontal_.size() - 1), along(0),
                         std::min((angle - last) / (round - last), 1.0F));
    const Cell column = find_cell(horizontal_, angle);
    return std::lerp(along(column.low), along(column.high), column.fraction);
}

Photometry parse_photometry(std::string_view text, const std::string& name) {
    std::string_view rest = after_tilt(text, name);
    const bool has_tilts = rest.starts_with("INCLUDE");
    // The rest of that line is the name of a file of tilts, or NONE.
    rest.remove_prefix(std::min(rest.find_first_of("\r\n"), rest.size()));
    Numbers numbers(rest, name);
    if (has_tilts) {
        static_cast<void>(numbers.next("lamp's position"));
        const std::size_t n = numbers.count("number of tilts");
        static_cast<void>(numbers.list(2 * n, "table of tilts"));
    }
    static_cast<void>(numbers.next("number of lamps"));
    static_cast<void>(numbers.next("lumens"));
    const float multiplier = numbers.next("multiplier");
    const std::size_t n_vertical = numbers.count("number of vertical angles");
    const std::size_t n_horizontal = numbers.count("number of horizontal angles");
    const float type = numbers.next("photometric type");
    for (const char* what : {"unit", "width", "length", "height"})
        static_cast<void>(numbers.next(what));
    const float ballast = numbers.next("ballast factor");
    const float lamp_photometry = numbers.next("ballast-lamp factor");
    static_cast<void>(numbers.next("watts"));
    if (type != 1 && type != 2 && type != 3)
        damaged(name, "its photometric type is none of 1 (C), 2 (B), 3 (A)");
    if (n_vertical == 0 || n_horizontal == 0) damaged(name, "it has no angles");
    std::vector<float> vertical =
        rising(numbers.list(n_vertical, "vertical angles"), name, "vertical angles");
    std::vector<float> horizontal =
        rising(numbers.list(n_horizontal, "horizontal angles"), name, "horizontal angles");
    // No overflow: both are at most the file's size, which is below 2^24.
    std::vector<float> candela = numbers.list(n_vertical * n_horizontal, "candela values");
    // The ballast-lamp factor is "for future use" since 1995; files that say 0 mean that.
    const float factor = multiplier * ballast * (lamp_photometry > 0 ? lamp_photometry : 1);
    for (float& value : candela) {
        value *= factor;
        if (!std::isfinite(value)) damaged(name, "its values leave the range of numbers");
        value = std::max(value, 0.0F);
    }
    return {static_cast<Photometry::Type>(static_cast<int>(type)), std::move(vertical),
            std::move(horizontal), std::move(candela)};
}

Photometry read_photometry(const std::string& path) {
    std::error_code ec;
    if (!std::filesystem::is_regular_file(path, ec))
        fail(Code::FileNotFound, "there is no photometric file \"" + path + "\"",
             "check the name and the search paths");
    const std::uintmax_t size = std::filesystem::file_size(path, ec);
    if (ec || size > kMaxPhotometryBytes)
        fail(Code::LimitFileSize,
             "photometric file \"" + path + "\" is larger than " +
                 std::to_string(kMaxPhotometryBytes) + " bytes",
             "IES files are small texts; check the name");
    std::ifstream file(path, std::ios::binary);
    // Not by iterators of the stream's buffer: they throw where a file cannot be read.
    std::string text(size, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file) fail(Code::FileUnreadable, "cannot read \"" + path + "\"", "check its permissions");
    return parse_photometry(text, path);
}

}  // namespace lightsieve
