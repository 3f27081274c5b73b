#include "render/mattes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "io/atomic_file.h"
#include "render/aov_plan.h"
#include "scene/cryptomatte.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

namespace fs = std::filesystem;

/// A part of a sample that opacity left by rounding is not worth a rank.
constexpr float kRounding = 1e-6F;
constexpr std::size_t kDigits = 2;  ///< at the end of a layer's name: which pair of ids it holds

/// The mattes of a driver's file by name, as its layers call them.
std::map<std::string, const Matte*> mattes_of(const AovPlan& plan, const PlannedDriver& driver) {
    std::map<std::string, const Matte*> out;
    for (const std::uint32_t index : driver.layers) {
        const PlannedLayer& layer = plan.layers[index];
        if (layer.source != LayerSource::Matte) continue;
        const std::string& name = layer.info.name;
        out.emplace(name.substr(0, name.size() - kDigits), &plan.mattes[layer.aov]);
    }
    return out;
}

/// shot.exr, crypto_object -> shot.crypto_object.json
std::string sidecar_path(const std::string& picture, const std::string& matte) {
    fs::path path(picture);
    if (path.extension() == ".exr") path.replace_extension();
    return path.string() + "." + matte + ".json";
}

}  // namespace

void MatteSums::begin(std::size_t n_pixels) {
    pixels_.resize(n_pixels);
    for (std::vector<Entry>& entries : pixels_)
        entries.clear();
}

void MatteSums::add_id(std::vector<Entry>& entries, std::uint32_t id, double weight) const {
    const auto at =
        std::lower_bound(entries.begin(), entries.end(), id,
                         [](const Entry& e, std::uint32_t wanted) { return e.id < wanted; });
    if (at != entries.end() && at->id == id)
        at->weight += weight;
    else
        entries.insert(at, {id, weight});
}

void MatteSums::add(std::size_t pixel, std::span<const MatteHit> hits, double weight) {
    std::vector<Entry>& entries = pixels_[pixel];
    float left = 1;
    for (const MatteHit& hit : hits) {
        if (hit.matte != matte_) continue;
        add_id(entries, hit.id, double{hit.weight} * weight);
        left -= hit.weight;
    }
    if (std::abs(left) > kRounding) add_id(entries, 0, double{left} * weight);
}

auto MatteSums::ranks(std::size_t pixel, std::size_t first, double norm) const
    -> std::array<Covered, 2> {
    std::vector<Entry> sorted = pixels_[pixel];
    std::erase_if(sorted, [](const Entry& e) { return !(e.weight > 0); });
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Entry& a, const Entry& b) { return a.weight > b.weight; });
    std::array<Covered, 2> out;
    for (std::size_t i = 0; i < out.size() && first + i < sorted.size(); ++i)
        out[i] = {sorted[first + i].id, static_cast<float>(sorted[first + i].weight * norm)};
    return out;
}

void MatteSums::save(ByteWriter& out) const {
    std::vector<std::uint32_t> counts;
    std::vector<Entry> all;
    for (const std::vector<Entry>& entries : pixels_) {
        counts.push_back(static_cast<std::uint32_t>(entries.size()));
        all.insert(all.end(), entries.begin(), entries.end());
    }
    out.put(counts);
    out.put(all);
}

bool MatteSums::load(ByteReader& in) {
    std::vector<std::uint32_t> counts;
    std::vector<Entry> all;
    if (!in.get(counts, pixels_.size())) return false;
    if (!in.get(all, std::accumulate(counts.begin(), counts.end(), std::size_t{0}))) return false;
    auto next = all.begin();
    for (std::size_t i = 0; i < pixels_.size(); next += counts[i++])
        pixels_[i].assign(next, next + counts[i]);
    return true;
}

Color MatteSums::preview(std::size_t pixel, double norm) const {
    // Green and blue are the hash's lower bits, as in Arnold's previews; red is free.
    Color out;
    for (const Entry& e : pixels_[pixel]) {
        const auto share = static_cast<float>(e.weight * norm);
        out.g += share * static_cast<float>(e.id << 8U) * 0x1p-32F;
        out.b += share * static_cast<float>(e.id << 16U) * 0x1p-32F;
    }
    return out;
}

void describe_mattes(const AovPlan& plan, const PlannedDriver& driver, ImageHeader& header) {
    for (const auto& [name, matte] : mattes_of(plan, driver)) {
        const std::string prefix = "cryptomatte/" + matte_key(name) + "/";
        header.metadata[prefix + "name"] = name;
        header.metadata[prefix + "hash"] = std::string("MurmurHash3_32");
        header.metadata[prefix + "conversion"] = std::string("uint32_to_float32");
        if (matte->sidecar)
            header.metadata[prefix + "manif_file"] =
                fs::path(sidecar_path(driver.driver->path(), name)).filename().string();
        else
            header.metadata[prefix + "manifest"] = manifest_json(matte->manifest);
    }
}

bool write_sidecars(const AovPlan& plan, const PlannedDriver& driver, Diagnostics& diagnostics) {
    try {
        for (const auto& [name, matte] : mattes_of(plan, driver)) {
            if (!matte->sidecar) continue;
            AtomicFile file(sidecar_path(driver.driver->path(), name));
            std::ofstream out(file.temporary(), std::ios::binary);
            out << manifest_json(matte->manifest);
            out.close();
            if (!out)
                throw InputError({Code::FileUnwritable,
                                  "cannot write \"" + file.path() + '"',
                                  {},
                                  "check the free space of the disk"});
            file.commit();
        }
    } catch (const InputError& e) {
        diagnostics.add(e);
        return false;
    }
    return true;
}

}  // namespace lightsieve
