#include "draw/gl/shaders.h"

static const char wall_vertex[] =
    "#version 330 core\n" GB_SHADERS_CAMERA "uniform vec2 size;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in float opacity;\n"
    "uniform mat3 rotation;\n"
    "uniform vec3 translation;\n"
    "out vec3 at;\n"
    "out vec3 across;\n"
    "out float alpha;\n"
    "void main()\n"
    "{\n"
    "    at = rotation * position + translation;\n"
    "    across = rotation * normal;\n"
    "    alpha = opacity;\n"
    "    float w = projection.w == 0.0 ? at.z : 1.0;\n"
    "    vec2 pixel = projection.xy + projection.z * vec2(at.x, -at.y) / w;\n"
    "    gl_Position = vec4((2.0 * pixel / size - 1.0) * w, 0.0, w);\n"
    "}\n";

/* As of glass, the opacity grows towards grazing angles.  Behind what is drawn, and in a cut,
 * there is nothing. */
static const char wall_fragment[] =
    "#version 330 core\n" GB_SHADERS_CAMERA GB_SHADERS_CUTS "uniform sampler2D depths;\n"
    "uniform vec3 tint;\n"
    "in vec3 at;\n"
    "in vec3 across;\n"
    "in float alpha;\n"
    "out vec4 colour;\n"
    "void main()\n"
    "{\n"
    "    float depth = (at.z - depth_range.x) / (depth_range.y - depth_range.x);\n"
    "    float seen = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    bool in_cut = cuts > 0;\n"
    "    for (int k = 0; k < cuts; k++) {\n"
    "        in_cut = in_cut && dot(cut[k].xyz, at) > cut[k].w;\n"
    "    }\n"
    "    if (in_cut || (seen < 1.0 && depth > seen)) {\n"
    "        discard;\n"
    "    }\n"
    "    vec3 view = projection.w == 0.0 ? normalize(at) : vec3(0.0, 0.0, 1.0);\n"
    "    float graze = 1.0 - abs(dot(normalize(across), view));\n"
    "    float a = mix(alpha, 0.5, graze * graze * graze);\n"
    "    colour = vec4(a * tint, a);\n"
    "}\n";

const struct gb_shaders_text gb_shaders_wall = {wall_vertex, wall_fragment, ""};
