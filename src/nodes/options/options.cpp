// options: what is rendered, how finely, and to where. One in a scene; the renderer reads it by parameter name.
#include <limits>

#include "scene/describe.h"

namespace lightsieve {
namespace {

/// A region bound that was not written: the edge of the frame.
constexpr std::int32_t kNoRegion = std::numeric_limits<std::int32_t>::min();

enum class StatsMode : std::int32_t { Overwrite, Append };
enum class BucketScanning : std::int32_t { Top, Left, Random, Spiral, Hilbert };

// Defaults: logs of Arnold for scenes that leave the parameter out.
struct Options {
    // Sampling.
    std::int32_t AA_samples = 1, AA_samples_max = 20, AA_seed = 1;
    bool enable_adaptive_sampling = false;
    float AA_adaptive_threshold = 0.015F;
    Name adaptive_aov;
    float AA_sample_clamp = 1e30F, indirect_sample_clamp = 10;
    bool AA_sample_clamp_affects_aovs = false;
    std::int32_t GI_diffuse_samples = 2, GI_specular_samples = 2, GI_transmission_samples = 2,
                 GI_sss_samples = 2;
    std::int32_t GI_volume_samples = 2, light_samples = 0;
    float indirect_specular_blur = 1, low_light_threshold = 0.001F;
    Name fis_filter{"none"};
    float fis_filter_width = 3;
    // Depths.
    std::int32_t GI_diffuse_depth = 0, GI_specular_depth = 0, GI_transmission_depth = 2,
                 GI_volume_depth = 0;
    std::int32_t GI_total_depth = 10, auto_transparency_depth = 10;
    bool dielectric_priorities = true;
    // Frame.
    std::int32_t xres = 320, yres = 240;
    float pixel_aspect_ratio = 1;
    std::int32_t region_min_x = kNoRegion, region_max_x = kNoRegion, region_min_y = kNoRegion,
                 region_max_y = kNoRegion;
    std::int32_t bucket_size = 64;
    BucketScanning bucket_scanning = BucketScanning::Spiral;
    float frame = 0, fps = 24, reference_time = 0, meters_per_unit = 1, nits_per_unit = 0;
    Name scene_units_name;
    // Nodes.
    NodeRef camera, background, atmosphere, shader_override, op, imager, color_manager,
        subdiv_dicing_camera;
    std::uint8_t background_visibility = 255;
    Array<NodeRef> aov_shaders, drivers;
    Array<Name> outputs, light_path_expressions;
    // Errors and switches.
    bool abort_on_error = true, abort_on_license_fail = false, skip_license_check = false;
    bool ignore_missing_textures = false;
    Color error_color_bad_texture{1, 0, 0}, error_color_bad_pixel{0, 0, 1},
        error_color_bad_shader{1, 0, 1};
    bool ignore_textures = false, ignore_shaders = false, ignore_atmosphere = false,
         ignore_lights = false;
    bool ignore_shadows = false, ignore_subdivision = false, ignore_displacement = false,
         ignore_bump = false;
    bool ignore_motion = false, ignore_motion_blur = false, ignore_dof = false, ignore_sss = false;
    bool ignore_smoothing = false, ignore_operators = false, ignore_imagers = false;
    Array<Name> ignore_list;
    // Files.
    Name texture_searchpath, procedural_searchpath, asset_searchpath, plugin_searchpath;
    bool texture_automip = true, texture_accept_unmipped = true, texture_accept_untiled = true;
    std::int32_t texture_autotile = 0, texture_max_open_files = 0;
    float texture_max_memory_MB = 4096, texture_diffuse_blur = 0.03125F, texture_specular_blur = 0;
    float texture_max_sharpen = 1.5F;
    bool texture_per_file_stats = false, texture_use_existing_tx = true,
         texture_auto_generate_tx = true;
    bool texture_conservative_lookups = true;
    Name texture_auto_tx_path;
    // Machine, log and host.
    std::int32_t threads = 0, max_subdivisions = 255;
    Name pin_threads{"auto"}, thread_priority{"lowest"}, render_device{"CPU"}, stats_file,
        profile_file;
    StatsMode stats_mode = StatsMode::Overwrite;
    bool enable_progressive_render = false, enable_progressive_pattern = false,
         parallel_node_init = true;
    bool enable_dependency_graph = false, enable_aov_composition = false,
         procedural_auto_instancing = true;
    bool procedural_force_expand = false, preserve_scene_data = false, curved_motionblur = false;
    bool enable_procedural_cache = true, enable_new_quad_light_sampler = true,
         enable_new_point_light_sampler = true;
    bool enable_deprecated_hair_absorption = false, sss_use_autobump = false,
         gpu_sparse_textures = true;
    bool enable_gpu_rendering = false, interactive_output_wait = false;
    std::int32_t gpu_default_min_memory_MB = 512, gpu_max_texture_resolution = 0,
                 progressive_min_AA_samples = -4;
    float interactive_target_fps = 30, interactive_target_fps_min = 5, interactive_fps_min = 5;
    Name gpu_default_names{"*"}, render_session_hints, log_file;
    std::int32_t log_verbosity = 1, log_max_warnings = 100;

    static NodeType describe();
};

void describe_sampling(Describe<Options>& d) {
    d.param("AA_samples", &Options::AA_samples,
            "Camera samples a pixel are the square of this; below 0: one sample in a block of "
            "pixels.")
        .range(-10, 100);
    d.param("AA_samples_max", &Options::AA_samples_max,
            "Most samples a pixel with adaptive sampling, squared; acts with "
            "enable_adaptive_sampling and AA_samples of at least 2.")
        .range(1, 100);
    d.param("AA_seed", &Options::AA_seed, "Seed of the sampling pattern.");
    d.param("enable_adaptive_sampling", &Options::enable_adaptive_sampling,
            "More samples where the picture is noisy: between the squares of AA_samples and "
            "AA_samples_max.");
    d.param(
         "AA_adaptive_threshold", &Options::AA_adaptive_threshold,
         "Noise at which adaptive sampling stops: a pixel's standard error over the root of its "
         "brightness, over blocks of 8 x 8 pixels.")
        .range(0, kInfinity);
    d.param("adaptive_aov", &Options::adaptive_aov,
            "Ours: the output, such as caustics, whose noise asks for samples; empty: the "
            "beauty.");
    d.param("AA_sample_clamp", &Options::AA_sample_clamp,
            "Largest channel of a camera sample; brighter ones are scaled down as a whole, in all "
            "AOVs.")
        .range(0, kInfinity);
    d.param("indirect_sample_clamp", &Options::indirect_sample_clamp,
            "The same for light that arrives indirectly.")
        .range(0, kInfinity);
    d.param("AA_sample_clamp_affects_aovs", &Options::AA_sample_clamp_affects_aovs,
            "Clamps always scale AOVs with the beauty here, so that AOVs add up.")
        .ignored();
    d.param("GI_diffuse_samples", &Options::GI_diffuse_samples,
            "Diffuse rays, squared, from where the camera looks; 0: no indirect diffuse light.")
        .range(0, 64);
    d.param("GI_specular_samples", &Options::GI_specular_samples,
            "The same for specular reflection; a perfect mirror needs one.")
        .range(0, 64);
    d.param("GI_transmission_samples", &Options::GI_transmission_samples,
            "The same for specular transmission.")
        .range(0, 64);
    d.param("GI_sss_samples", &Options::GI_sss_samples, "The same for subsurface scattering.")
        .range(0, 64);
    d.param("GI_volume_samples", &Options::GI_volume_samples,
            "The same for scattering in volumes.")
        .range(0, 64);
    d.param(
         "light_samples", &Options::light_samples,
         "Above 0: samples of all lights together where a path splits, squared; what lights say "
         "themselves does not count.")
        .range(0, 64);
    d.param("indirect_specular_blur", &Options::indirect_specular_blur,
            "Arnold's roughening of indirect highlights; never done here.")
        .ignored();
    d.param("low_light_threshold", &Options::low_light_threshold,
            "Contributions below this are traced only sometimes, without bias.")
        .range(0, 1);
    d.param("fis_filter", &Options::fis_filter,
            "Arnold's switch for filter importance sampling, which is always on here.")
        .ignored();
    d.param("fis_filter_width", &Options::fis_filter_width, "Width for fis_filter.").ignored();
}

void describe_depths(Describe<Options>& d) {
    d.param("GI_diffuse_depth", &Options::GI_diffuse_depth,
            "Diffuse bounces beyond the first hit.")
        .hard_range(0, 10000);
    d.param("GI_specular_depth", &Options::GI_specular_depth,
            "Specular reflections beyond the first hit.")
        .hard_range(0, 10000);
    d.param("GI_transmission_depth", &Options::GI_transmission_depth, "Specular transmissions.")
        .hard_range(0, 10000);
    d.param("GI_volume_depth", &Options::GI_volume_depth, "Bounces in volumes.")
        .hard_range(0, 10000);
    d.param("GI_total_depth", &Options::GI_total_depth, "Bounces of all kinds together.")
        .hard_range(0, 10000);
    d.param("auto_transparency_depth", &Options::auto_transparency_depth,
            "Transparent surfaces (opacity) that one ray passes.")
        .hard_range(0, 10000);
    d.param(
        "dielectric_priorities", &Options::dielectric_priorities,
        "Where clear bodies overlap, the one of higher dielectric_priority is there; off: every "
        "surface borders on air.");
}

void describe_frame(Describe<Options>& d) {
    d.param("xres", &Options::xres, "Width of the frame.").unit("pixels").hard_range(1, 1 << 20);
    d.param("yres", &Options::yres, "Height of the frame.").unit("pixels").hard_range(1, 1 << 20);
    d.param("pixel_aspect_ratio", &Options::pixel_aspect_ratio,
            "Width of a pixel over its height.")
        .hard_range(0.01F, 100);
    d.param("region_min_x", &Options::region_min_x,
            "First column that is rendered; may lie outside the frame. Unset: 0.")
        .unit("pixels");
    d.param("region_max_x", &Options::region_max_x,
            "Last column that is rendered. Unset: xres - 1.")
        .unit("pixels");
    d.param("region_min_y", &Options::region_min_y,
            "First row that is rendered, from the top. Unset: 0.")
        .unit("pixels");
    d.param("region_max_y", &Options::region_max_y, "Last row that is rendered. Unset: yres - 1.")
        .unit("pixels");
    d.param("bucket_size", &Options::bucket_size,
            "Side of the square that one thread renders at a time.")
        .unit("pixels")
        .hard_range(8, 1024);
    d.param("bucket_scanning", &Options::bucket_scanning,
            "Order of the buckets; the picture does not depend on it.")
        .names({"top", "left", "random", "spiral", "hilbert"})
        .ignored();
    d.param("frame", &Options::frame, "Number of the frame, for file names and headers.");
    d.param("fps", &Options::fps, "Frames a second, for headers.").ignored();
    d.param("reference_time", &Options::reference_time, "Time of ignore_motion_blur.")
        .unit("frames");
    d.param("meters_per_unit", &Options::meters_per_unit,
            "Length of a scene unit, for information.")
        .unit("m")
        .ignored();
    d.param("nits_per_unit", &Options::nits_per_unit, "Luminance of 1, for information.")
        .unit("cd/m^2")
        .ignored();
    d.param("scene_units_name", &Options::scene_units_name,
            "Name of the scene's units, for information.")
        .ignored();
}

void describe_nodes(Describe<Options>& d) {
    d.param("camera", &Options::camera, "The camera of outputs that name none.");
    d.param("outputs", &Options::outputs,
            "What is written: `[CAMERA] AOV TYPE FILTER DRIVER [LAYER] [HALF]`, one a string.");
    d.param("light_path_expressions", &Options::light_path_expressions,
            "AOVs by expression: `NAME EXPRESSION`, one a string.");
    d.param("background", &Options::background, "Shader that colours rays which leave the scene.");
    d.param("background_visibility", &Options::background_visibility,
            "Ray types that see the background (a mask as `visibility` of shapes).");
    d.param("shader_override", &Options::shader_override, "Shader that replaces all others.");
    d.param("atmosphere", &Options::atmosphere, "Shader of a volume that fills the scene.");
    d.param("operator", &Options::op,
            "Last node of a chain that edits the scene before rendering.");
    d.param("aov_shaders", &Options::aov_shaders,
            "Shaders that run after each surface shader, to write AOVs.");
    d.param("drivers", &Options::drivers, "Drivers that list their own outputs.").pending();
    d.param("imager", &Options::imager,
            "The last of a chain of imagers, for drivers that have none of their own.");
    d.param("color_manager", &Options::color_manager,
            "Where names of colour spaces come from. None: the configuration that $OCIO names, or "
            "else the "
            "usual spaces of ACES, rendering in ACEScg.");
    d.param("subdiv_dicing_camera", &Options::subdiv_dicing_camera,
            "Camera for adaptive subdivision of meshes that name none.");
}

void describe_switches(Describe<Options>& d) {
    d.param(
        "abort_on_error", &Options::abort_on_error,
        "Errors in expressions stop the render; off: their AOVs are black and the rest renders.");
    d.param("abort_on_license_fail", &Options::abort_on_license_fail, "Arnold's licence check.")
        .ignored();
    d.param("skip_license_check", &Options::skip_license_check, "Arnold's licence check.")
        .ignored();
    d.param("ignore_missing_textures", &Options::ignore_missing_textures,
            "Missing textures get their replacement colour and a warning instead of an error.");
    d.param("error_color_bad_texture", &Options::error_color_bad_texture,
            "Arnold's colour for textures that cannot be read.")
        .ignored();
    d.param("error_color_bad_pixel", &Options::error_color_bad_pixel,
            "Arnold's colour for samples that are not finite; here they are dropped and counted.")
        .ignored();
    d.param("error_color_bad_shader", &Options::error_color_bad_shader,
            "Arnold's colour for shaders that fail.")
        .ignored();
    d.param(
        "ignore_textures", &Options::ignore_textures,
        "Links to image nodes are cut: parameters keep the values that are written beside them.");
    d.param("ignore_shaders", &Options::ignore_shaders, "Every shape is white clay.");
    d.param("ignore_atmosphere", &Options::ignore_atmosphere, "Renders without atmosphere.");
    d.param("ignore_lights", &Options::ignore_lights, "Renders without lights.");
    d.param("ignore_shadows", &Options::ignore_shadows, "No light casts shadows.");
    d.param("ignore_subdivision", &Options::ignore_subdivision, "Renders without subdivision.");
    d.param("ignore_displacement", &Options::ignore_displacement, "Renders without displacement.");
    d.param("ignore_bump", &Options::ignore_bump,
            "Renders without bump and normal maps: no shader drives a normal.");
    d.param("ignore_motion", &Options::ignore_motion,
            "Renders as if nothing had motion keys but the first.");
    d.param("ignore_motion_blur", &Options::ignore_motion_blur,
            "Renders with an instantaneous shutter at reference_time; the AOV motionvector still "
            "shows what moves while the camera's shutter is open.");
    d.param("ignore_dof", &Options::ignore_dof, "Renders without depth of field.");
    d.param("ignore_sss", &Options::ignore_sss, "Renders without subsurface scattering.");
    d.param("ignore_smoothing", &Options::ignore_smoothing, "Renders meshes with face normals.");
    d.param("ignore_operators", &Options::ignore_operators, "Operators do nothing.");
    d.param("ignore_imagers", &Options::ignore_imagers, "Skips imagers.");
    d.param("ignore_list", &Options::ignore_list,
            "Types of nodes that are left out, with all that refers to them.");
}

void describe_files(Describe<Options>& d) {
    d.param("texture_searchpath", &Options::texture_searchpath,
            "Folders in which textures are looked for, separated by `;` or `:`.");
    d.param("procedural_searchpath", &Options::procedural_searchpath,
            "Folders in which files of procedurals are looked for.");
    d.param("asset_searchpath", &Options::asset_searchpath,
            "Folders in which all files are looked for.");
    d.param("plugin_searchpath", &Options::plugin_searchpath, "Folders of Arnold's plug-ins.")
        .ignored();
    d.param("texture_automip", &Options::texture_automip, "Arnold's making of mip maps.")
        .ignored();
    d.param("texture_autotile", &Options::texture_autotile, "Arnold's making of tiles.").ignored();
    d.param("texture_accept_unmipped", &Options::texture_accept_unmipped,
            "Arnold's refusal of textures without mip maps.")
        .ignored();
    d.param("texture_accept_untiled", &Options::texture_accept_untiled,
            "Arnold's refusal of textures without tiles.")
        .ignored();
    d.param("texture_max_memory_MB", &Options::texture_max_memory_MB,
            "Bound on the texels in memory; what does not fit is read again when it is needed.")
        .unit("MB")
        .range(16, 1 << 24);
    d.param("texture_max_open_files", &Options::texture_max_open_files,
            "Open files of Arnold's texture cache.")
        .ignored();
    d.param("texture_max_sharpen", &Options::texture_max_sharpen,
            "Arnold's sharpening of texture look-ups.")
        .ignored();
    d.param("texture_diffuse_blur", &Options::texture_diffuse_blur,
            "Arnold's blur of textures that diffuse rays see.")
        .ignored();
    d.param("texture_specular_blur", &Options::texture_specular_blur,
            "Arnold's blur of textures that specular rays see.")
        .ignored();
    d.param("texture_per_file_stats", &Options::texture_per_file_stats, "Arnold's log.").ignored();
    d.param("texture_use_existing_tx", &Options::texture_use_existing_tx,
            "Arnold's choice of .tx files.")
        .ignored();
    d.param("texture_auto_generate_tx", &Options::texture_auto_generate_tx,
            "Arnold's making of .tx files.")
        .ignored();
    d.param("texture_auto_tx_path", &Options::texture_auto_tx_path,
            "Folder of the .tx files that Arnold makes.")
        .ignored();
    d.param("texture_conservative_lookups", &Options::texture_conservative_lookups,
            "Arnold's choice of mip levels.")
        .ignored();
}

void describe_machine(Describe<Options>& d) {
    d.param("threads", &Options::threads, "Arnold's threads; here a switch of the command.")
        .ignored();
    d.param("pin_threads", &Options::pin_threads, "Arnold's binding of threads to processors.")
        .ignored();
    d.param("thread_priority", &Options::thread_priority, "Arnold's priority of threads.")
        .ignored();
    d.param("render_device", &Options::render_device, "Arnold's choice of CPU or GPU.").ignored();
    d.param("enable_gpu_rendering", &Options::enable_gpu_rendering,
            "Arnold's choice of CPU or GPU.")
        .ignored();
    d.param("gpu_default_names", &Options::gpu_default_names, "Arnold's choice of GPU.").ignored();
    d.param("gpu_default_min_memory_MB", &Options::gpu_default_min_memory_MB,
            "Arnold's choice of GPU.")
        .ignored();
    d.param("gpu_max_texture_resolution", &Options::gpu_max_texture_resolution,
            "Arnold's limit for GPUs.")
        .ignored();
    d.param("gpu_sparse_textures", &Options::gpu_sparse_textures, "Arnold's textures on GPUs.")
        .ignored();
    d.param("max_subdivisions", &Options::max_subdivisions,
            "Largest number of subdivision steps of any mesh.");
    d.param("curved_motionblur", &Options::curved_motionblur,
            "Motion along curves through the keys; here it is along lines.")
        .pending();
    d.param("enable_progressive_render", &Options::enable_progressive_render,
            "Order of samples; the picture does not depend on it.")
        .ignored();
    d.param("enable_progressive_pattern", &Options::enable_progressive_pattern,
            "Arnold's sampling pattern.")
        .ignored();
    d.param("progressive_min_AA_samples", &Options::progressive_min_AA_samples,
            "Arnold's first progressive pass.")
        .ignored();
    d.param("interactive_target_fps", &Options::interactive_target_fps,
            "Arnold's interactive session.")
        .ignored();
    d.param("interactive_target_fps_min", &Options::interactive_target_fps_min,
            "Arnold's interactive session.")
        .ignored();
    d.param("interactive_fps_min", &Options::interactive_fps_min, "Arnold's interactive session.")
        .ignored();
    d.param("interactive_output_wait", &Options::interactive_output_wait,
            "Arnold's interactive session.")
        .ignored();
    d.param("render_session_hints", &Options::render_session_hints,
            "Arnold's interactive session.")
        .ignored();
    d.param("parallel_node_init", &Options::parallel_node_init, "Arnold's start-up.").ignored();
    d.param("enable_dependency_graph", &Options::enable_dependency_graph, "Arnold's start-up.")
        .ignored();
    d.param("enable_procedural_cache", &Options::enable_procedural_cache, "Arnold's start-up.")
        .ignored();
    d.param("enable_new_quad_light_sampler", &Options::enable_new_quad_light_sampler,
            "Arnold's light sampling.")
        .ignored();
    d.param("enable_new_point_light_sampler", &Options::enable_new_point_light_sampler,
            "Arnold's light sampling.")
        .ignored();
    d.param("enable_aov_composition", &Options::enable_aov_composition,
            "Arnold's blending of AOVs that shaders write.")
        .ignored();
    d.param("enable_deprecated_hair_absorption", &Options::enable_deprecated_hair_absorption,
            "Arnold's older hair.")
        .ignored();
    d.param("sss_use_autobump", &Options::sss_use_autobump,
            "Bump of displaced shapes in subsurface rays; acts with displacement.")
        .ignored();
    d.param("procedural_auto_instancing", &Options::procedural_auto_instancing,
            "Procedurals of the same file share what it holds.");
    d.param("procedural_force_expand", &Options::procedural_force_expand, "Arnold's start-up.")
        .ignored();
    d.param("preserve_scene_data", &Options::preserve_scene_data, "Arnold's memory.").ignored();
    d.param("stats_file", &Options::stats_file,
            "File that a render's statistics are written to, for machines (JSON); empty: none.");
    d.param("stats_mode", &Options::stats_mode,
            "Whether that file is written anew, or goes on with what it holds.")
        .names({"overwrite", "append"});
    d.param("profile_file", &Options::profile_file, "Arnold's log.").ignored();
    d.param("log_file", &Options::log_file,
            "File that gets what the command line says; empty: none.");
    d.param("log_verbosity", &Options::log_verbosity,
            "0: errors only; 1: warnings, progress and a summary; 2 and more: everything. -v and "
            "--quiet win.");
    d.param("log_max_warnings", &Options::log_max_warnings, "Warnings that are printed.");
}

NodeType Options::describe() {
    Describe<Options> d("options", NodeKind::Options,
                        "What is rendered, how finely, and what is written.");
    describe_sampling(d);
    describe_depths(d);
    describe_frame(d);
    describe_nodes(d);
    describe_switches(d);
    describe_files(d);
    describe_machine(d);
    return d.done();
}

}  // namespace

NodeType node_options() { return Options::describe(); }

}  // namespace lightsieve
