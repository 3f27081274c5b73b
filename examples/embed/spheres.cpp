// A small path tracer of spheres that knows nothing of light path expressions, with the engine of
// Lightsieve put in. What had to be added is marked with (1) to (4).
//
//     spheres FOLDER [NAME=EXPRESSION | NAME@GROUP=EXPRESSION ...]
//
// writes FOLDER/NAME.pfm (linear, 32 bits) for each AOV.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <lightsieve/lpe.h>

namespace ls = lightsieve::embed;

namespace {

// ------------------------------------------------------------------------------------ arithmetic

struct Vec {
    float x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec operator*(float s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec normalize(Vec a) { return 1 / std::sqrt(dot(a, a)) * a; }
Vec reflect(Vec direction, Vec normal) { return direction - 2 * dot(direction, normal) * normal; }

// --------------------------------------------------------------------------------------- a scene

struct Sphere {
    Vec centre;
    float radius;
    Vec diffuse;          // albedo
    float coat = 0;       // reflectance of a clear mirror over it
    bool glass = false;   // refracts, and nothing else
    Vec light{};          // radiance that it gives off
    std::string group{};  // of the light; empty: it is an object that glows
};

const std::vector<Sphere> kSpheres = {
    {{0, -1000, 0}, 1000, {.6f, .6f, .6f}},
    {{-2.1f, 1, 0}, 1, {.7f, .2f, .1f}, .25f},
    {{0, 1, 0}, 1, {}, 0, true},
    {{2.1f, 1, 0}, 1, {.1f, .3f, .7f}},
    {{.9f, .3f, 1.6f}, .3f, {}, 0, false, {1, .8f, .3f}},
    {{-4, 6, 4}, 1, {}, 0, false, {16, 15, 13}, "key"},
    {{1.2f, 2.8f, -2}, .4f, {}, 0, false, {25, 30, 50}, "rim"},
};
const Vec kSky{.15f, .2f, .3f};
constexpr int kWidth = 120, kHeight = 80, kSamples = 64, kMaxBounces = 8;

// (1) What can happen in this renderer: one column of the engine's table for each. Found once.
struct Columns {
    ls::Column diffuse, coat, glass_reflection, glass_refraction, glow, sky;
    std::vector<ls::Column> lights;  // of each sphere that is one
};

struct Events {
    std::uint32_t diffuse, coat, glass_reflection, glass_refraction, glow, sky;
    std::vector<std::uint32_t> lights;
};

Events add_events(ls::Compiler& compiler) {
    using ls::Kind, ls::Lobe;
    Events events{compiler.add_event({Kind::Reflection, Lobe::Diffuse}),
                  compiler.add_event({Kind::Reflection, Lobe::Specular, {"coat"}}),
                  compiler.add_event({Kind::Reflection, Lobe::Specular}),
                  compiler.add_event({Kind::Transmission, Lobe::Specular}),
                  compiler.add_event({Kind::Object}),
                  compiler.add_event({Kind::Background}),
                  {}};
    for (const Sphere& sphere : kSpheres)
        events.lights.push_back(
            sphere.group.empty() ? events.glow
                                 : compiler.add_event({Kind::Light, Lobe::None, {sphere.group}}));
    return events;
}

Columns columns_of(const ls::Program& program, const Events& events) {
    Columns out{program.column(events.diffuse),
                program.column(events.coat),
                program.column(events.glass_reflection),
                program.column(events.glass_refraction),
                program.column(events.glow),
                program.column(events.sky),
                {}};
    for (const std::uint32_t light : events.lights)
        out.lights.push_back(program.column(light));
    return out;
}

// ---------------------------------------------------------------------------------------- tracing

struct Ray {
    Vec origin, direction;
};

struct Hit {
    const Sphere* sphere = nullptr;
    float distance = 1e30f;
};

Hit nearest(const Ray& ray) {
    Hit best;
    for (const Sphere& sphere : kSpheres) {
        const Vec to = sphere.centre - ray.origin;
        const float middle = dot(to, ray.direction);
        // From the ray's distance to the centre: |to|^2 - radius^2 would lose the floor's digits.
        const Vec aside = to - middle * ray.direction;
        const float half_squared = sphere.radius * sphere.radius - dot(aside, aside);
        if (half_squared < 0) continue;
        const float half = std::sqrt(half_squared);
        const float epsilon = 1e-3f;
        const float distance = middle - half > epsilon ? middle - half : middle + half;
        if (distance > epsilon && distance < best.distance) best = {&sphere, distance};
    }
    return best;
}

class Tracer {
  public:
    Tracer(const ls::Program& program, Columns columns)
        : program_(program), columns_(std::move(columns)), film_(program.n_atoms()) {}

    // One path from the camera; what it finds is in `film` afterwards.
    void trace(Ray ray, std::mt19937& random) {
        Vec throughput{1, 1, 1};
        // (2) A path carries a state. (Were there several automata, it would carry one of each.)
        ls::State state = program_.start();
        for (int bounce = 0;; ++bounce) {
            const Hit hit = nearest(ray);
            if (hit.sphere == nullptr) return add(state, columns_.sky, throughput * kSky);
            const Sphere& sphere = *hit.sphere;
            const auto index = static_cast<std::size_t>(&sphere - kSpheres.data());
            if (dot(sphere.light, sphere.light) > 0)
                return add(state, columns_.lights[index], throughput * sphere.light);
            if (bounce == kMaxBounces) return;
            const ls::Column event = scatter(sphere, hit.distance, ray, throughput, random);
            state = program_.step(state, event);
            // Nothing that can still happen is in an AOV: this path need not be finished.
            if (!program_.live_light(state)) return;
        }
    }

    // The sums over all samples, one for each atom.
    const std::vector<Vec>& film() const { return film_; }
    void clear() { film_.assign(film_.size(), {}); }

  private:
    // (3) The path ends: its light goes to one number, however many AOVs there are.
    void add(ls::State state, ls::Column terminal, Vec radiance) {
        const ls::Atom atom = program_.atom(state, terminal);
        if (atom != ls::kNoAtom) film_[atom] = film_[atom] + radiance;
    }

    // Moves the ray to where it goes on. Returns what happened.
    ls::Column scatter(const Sphere& sphere, float distance, Ray& ray, Vec& throughput,
                       std::mt19937& random) const {
        ray.origin = ray.origin + distance * ray.direction;
        Vec normal = normalize(ray.origin - sphere.centre);
        const float chance = uniform_(random);
        if (sphere.glass) return pass_glass(normal, chance, ray);
        if (chance < sphere.coat) {
            ray.direction = reflect(ray.direction, normal);
            return columns_.coat;
        }
        // Cosine distribution: a point of the unit sphere, put on the tip of the normal.
        const float z = 2 * uniform_(random) - 1, angle = 6.2831853f * uniform_(random);
        const float r = std::sqrt(1 - z * z);
        const Vec tip{r * std::cos(angle), r * std::sin(angle), z};
        ray.direction = normalize(1.0001f * normal + tip);
        throughput = throughput * sphere.diffuse;
        return columns_.diffuse;
    }

    // Snell's law and Schlick's reflectance (1994, eq. 15), index of refraction 1.5.
    ls::Column pass_glass(Vec normal, float chance, Ray& ray) const {
        float cosine = -dot(ray.direction, normal), eta = 1 / 1.5f;
        if (cosine < 0) {
            normal = -1 * normal;
            cosine = -cosine;
            eta = 1.5f;
        }
        const float inside_squared = 1 - eta * eta * (1 - cosine * cosine);
        // Schlick's cosine is that of the side with the larger angle.
        const float inside = std::sqrt(std::max(0.0f, inside_squared));
        const float c = 1 - (eta > 1 ? inside : cosine);
        const float fresnel = inside_squared <= 0 ? 1 : .04f + .96f * c * c * c * c * c;
        if (chance < fresnel) {
            ray.direction = reflect(ray.direction, normal);
            return columns_.glass_reflection;
        }
        ray.direction = normalize(eta * ray.direction + (eta * cosine - inside) * normal);
        return columns_.glass_refraction;
    }

    const ls::Program& program_;
    Columns columns_;
    std::vector<Vec> film_;
    mutable std::uniform_real_distribution<float> uniform_{0, 1};
};

// ------------------------------------------------------------------------------------- the picture

struct Aov {
    std::string name, group, expression;
    bool has_group = false;
};

// NAME=EXPRESSION or NAME@GROUP=EXPRESSION.
Aov parse_aov(const std::string& text) {
    const std::size_t equals = text.find('='), at = text.find('@');
    Aov out{
        text.substr(0, equals), {}, equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (at < equals) {
        out.name = text.substr(0, at);
        out.group = text.substr(at + 1, equals - at - 1);
        out.has_group = true;
    }
    return out;
}

using Picture = std::vector<Vec>;

std::vector<Picture> render(const ls::Program& program, const Columns& columns) {
    std::vector<Picture> out(program.n_aovs(), Picture(kWidth * kHeight));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    Tracer tracer(program, columns);
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
        tracer.clear();
        for (int sample = 0; sample < kSamples; ++sample) {
            const float x = static_cast<float>(pixel % kWidth) + uniform(random) - kWidth / 2.0f;
            const float y = kHeight / 2.0f - static_cast<float>(pixel / kWidth) - uniform(random);
            tracer.trace({{0, 1.6f, 9}, normalize({x, y - 8, -170})}, random);
        }
        // (4) An AOV is the sum of its atoms.
        for (ls::Atom atom = 0; atom < program.n_atoms(); ++atom)
            for (const std::uint32_t aov : program.aovs_of(atom))
                out[aov][static_cast<std::size_t>(pixel)] =
                    out[aov][static_cast<std::size_t>(pixel)] +
                    1.0f / kSamples * tracer.film()[atom];
    }
    return out;
}

// Portable float map, rows from the bottom.
bool write_pfm(const std::string& path, const Picture& picture) {
    std::ofstream file(path, std::ios::binary);
    file << "PF\n" << kWidth << " " << kHeight << "\n-1\n";
    for (int row = kHeight - 1; row >= 0; --row)
        file.write(reinterpret_cast<const char*>(&picture[static_cast<std::size_t>(row * kWidth)]),
                   kWidth * sizeof(Vec));
    return file.good();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::cerr << "usage: spheres FOLDER NAME=EXPRESSION...\n";
        return 2;
    }
    ls::Compiler compiler;
    const Events events = add_events(compiler);
    std::vector<Aov> aovs;
    for (int i = 2; i < argc; ++i) {
        aovs.push_back(parse_aov(argv[i]));
        const Aov& aov = aovs.back();
        if (aov.has_group)
            compiler.add_aov(aov.name, aov.expression, aov.group);
        else
            compiler.add_aov(aov.name, aov.expression);
    }
    const ls::Program program = compiler.compile();
    bool failed = program.n_automata() > 1;
    for (const ls::Diagnostic& found : compiler.diagnostics()) {
        std::cerr << found.text << "\n";
        failed = failed || found.severity == ls::Severity::Error;
    }
    if (failed) return 1;
    const std::vector<Picture> pictures = render(program, columns_of(program, events));
    for (std::size_t i = 0; i < aovs.size(); ++i)
        if (!write_pfm(std::string(argv[1]) + "/" + aovs[i].name + ".pfm", pictures[i])) return 1;
}
