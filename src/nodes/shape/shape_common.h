// What all shapes share: the documentation of `ShapeCommon`, and parameters that only say how Arnold would go about it.
//
// Every shape node derives from `ShapeNode` and calls `describe_shape_common` first. The renderer reads the
// `ShapeCommon` part through NodeType::shape_common.
#pragma once

#include "scene/describe.h"
#include "scene/shape.h"

namespace lightsieve {

/// Parameters of every shape node that the renderer does not read.
struct ShapeNode : ShapeCommon {
    Name toon_id;
};

/// Documents the parameters of `ShapeNode`.
template <class T>
void describe_shape_common(Describe<T>& d) {
    d.param("visibility", &ShapeCommon::visibility,
            "Ray types that see the shape, added up: camera 1, shadow 2, diffuse_transmit 4, "
            "specular_transmit 8, volume 16, "
            "diffuse_reflect 32, specular_reflect 64, subsurface 128.");
    d.param("sidedness", &ShapeCommon::sidedness,
            "Ray types (as for visibility) that see both sides; others pass back faces.");
    d.param("shader", &ShapeCommon::shader,
            "Shader of the surface; several are chosen from by shidxs.");
    d.param("matrix", &ShapeCommon::matrix,
            "Placement in the world, row vectors; one matrix a motion key.");
    d.param("motion_start", &ShapeCommon::motion_start, "Time of the first motion key.")
        .unit("frames");
    d.param("motion_end", &ShapeCommon::motion_end, "Time of the last motion key.").unit("frames");
    d.param("receive_shadows", &ShapeCommon::receive_shadows,
            "Other shapes cast shadows on this one.");
    d.param("self_shadows", &ShapeCommon::self_shadows, "The shape casts shadows on itself.");
    d.param("matte", &ShapeCommon::matte,
            "A hole in the picture: black, without alpha, for camera rays.");
    d.param("invert_normals", &ShapeCommon::invert_normals, "Turns the outward side inward.");
    d.param("opaque", &ShapeCommon::opaque, "Deprecated; opacity of the shader decides.")
        .ignored();
    d.param("ray_bias", &ShapeCommon::ray_bias, "Arnold's offset of rays that leave the surface.")
        .unit("scene units")
        .ignored();
    d.param("id", &ShapeCommon::id, "Value of the AOV ID; 0: a hash of the name.");
    d.param("use_light_group", &ShapeCommon::use_light_group,
            "Only the lights of light_group illuminate the shape.");
    d.param("light_group", &ShapeCommon::light_group, "Lights for use_light_group.");
    d.param("use_shadow_group", &ShapeCommon::use_shadow_group,
            "The shape casts shadows in the lights of shadow_group only.");
    d.param("shadow_group", &ShapeCommon::shadow_group, "Lights for use_shadow_group.");
    d.param("trace_sets", &ShapeCommon::trace_sets,
            "Names by which shaders (trace_set parameters) choose what their rays meet.");
    d.param("transform_type", &ShapeCommon::transform_type,
            "How matrices between motion keys are found: element by element, or turning about the "
            "origin or the middle of the shape, which moves along a line.")
        .names({"linear", "rotate_about_origin", "rotate_about_center"});
    d.param("step_size", &ShapeCommon::step_size,
            "Above 0 the shape is no surface but the container of a volume. How large it is does "
            "not matter: free paths are drawn exactly, not stepped.")
        .unit("scene units");
    d.param(
         "volume_padding", &ShapeCommon::volume_padding,
         "How much a volume reaches beyond its box; containers that are meshes keep their shape.")
        .unit("scene units");
    d.param("toon_id", &ShapeNode::toon_id, "Name for contour rendering, which is not supported.")
        .ignored();
}

/// The mesh of a box, faces outward, for shapes that are boundaries of volumes.
[[nodiscard]] TriangleMesh box_mesh(const Box3f& box);

}  // namespace lightsieve
