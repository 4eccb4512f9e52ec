/* Pictures of a scene by OpenGL, in tiles, so that memory is bounded.  Each tile takes
 * four passes: the first finds what every sample sees (index and depth of spheres,
 * rods, facets and edges), the second colours the samples with shadow and occlusion,
 * the third blends translucent walls over the colours, and the fourth averages the
 * samples of each pixel.  The shadow map, the depths seen from the light, is drawn once
 * and serves all tiles. */

#include "draw/renderer.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/gl_context.h"
#include "draw/hidden.h"

/* The GLSL of one program. */
struct shader {
    const char *vertex, *fragment;
    const char *more; /* second part of the fragment shader; "": none */
};

/* projection: pixel of the axis, focal length in samples, 1 when orthographic.
 * depth_range: depth of 0 and of 1 in the depth buffer, which is linear. */
#define GLSL_CAMERA "uniform vec4 projection;\nuniform vec2 depth_range;\n"

/* Half-spaces n p > c: normal and c. */
#define GLSL_CUTS "uniform int cuts;\nuniform vec4 cut[3];\n"

/* Intersection of a ray and a sphere.  Distances are measured from the point of the ray
 * nearest to the centre: the plain quadratic loses all digits when the viewer is many
 * diameters away. */
static const char sphere_vertex[] =
    "#version 330 core\n" GLSL_CAMERA "uniform samplerBuffer spheres;\n"
    "uniform vec2 size;\n"
    "uniform mat3 rotation;\n"
    "uniform vec3 translation;\n"
    "layout(location = 0) in uint index;\n"
    "flat out vec4 ball;\n"
    "flat out uint id;\n"
    "void main()\n"
    "{\n"
    "    vec4 raw = texelFetch(spheres, int(index));\n"
    "    ball = vec4(rotation * raw.xyz + translation, raw.w);\n"
    "    id = index;\n"
    "    vec2 low = ball.xy - ball.w;\n"
    "    vec2 high = ball.xy + ball.w;\n"
    "    if (projection.w == 0.0) {\n"
    "        float d = ball.z * ball.z - ball.w * ball.w;\n"
    "        vec2 s = ball.w * sqrt(ball.xy * ball.xy + d);\n"
    "        low = (ball.xy * ball.z - s) / d;\n"
    "        high = (ball.xy * ball.z + s) / d;\n"
    "    }\n"
    "    vec2 at = mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1));\n"
    "    vec2 pixel = projection.xy + projection.z * vec2(at.x, -at.y);\n"
    "    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);\n"
    "}\n";

/* What lies in all half-spaces of the cut is not there: a ray that would enter the sphere in
 * it goes on to its end. */
static const char sphere_fragment[] =
    "#version 330 core\n" GLSL_CAMERA GLSL_CUTS "flat in vec4 ball;\n"
    "flat in uint id;\n"
    "out uint seen;\n"
    "void main()\n"
    "{\n"
    "    vec2 s = (gl_FragCoord.xy - projection.xy) /\n"
    "             vec2(projection.z, -projection.z);\n"
    "    vec3 ray = projection.w == 0.0 ? vec3(s, 1.0) : vec3(0.0, 0.0, 1.0);\n"
    "    vec3 from = projection.w == 0.0 ? vec3(0.0) : vec3(s, 0.0);\n"
    "    vec3 to = ball.xyz - from;\n"
    "    float a = dot(ray, ray);\n"
    "    float t = dot(to, ray) / a;\n"
    "    vec3 offset = to - t * ray;\n"
    "    float h = ball.w * ball.w - dot(offset, offset);\n"
    "    if (h < 0.0) {\n"
    "        discard;\n"
    "    }\n"
    "    float depth = t - sqrt(h / a);\n"
    "    float gap_end = 1e30;\n"
    "    bool in_gap = cuts > 0;\n"
    "    for (int k = 0; k < cuts; k++) {\n"
    "        float slope = dot(cut[k].xyz, ray);\n"
    "        float above = dot(cut[k].xyz, from + depth * ray) - cut[k].w;\n"
    "        in_gap = in_gap && above > 0.0;\n"
    "        gap_end = slope < 0.0 ? min(gap_end, depth - above / slope) : gap_end;\n"
    "    }\n"
    "    if (in_gap) {\n"
    "        if (gap_end > t + sqrt(h / a)) {\n"
    "            discard;\n"
    "        }\n"
    "        depth = gap_end;\n"
    "    }\n"
    "    gl_FragDepth = (depth - depth_range.x) / (depth_range.y - depth_range.x);\n"
    "    seen = id;\n"
    "}\n";

/* A rod is a cylinder with a hemisphere at either end.  Distances are measured from the
 * point of the ray nearest to the first end, as for spheres. */
static const char rod_vertex[] =
    "#version 330 core\n" GLSL_CAMERA "uniform samplerBuffer rods;\n"
    "uniform vec2 size;\n"
    "uniform mat3 rotation;\n"
    "uniform vec3 translation;\n"
    "uniform uint first;\n"
    "layout(location = 0) in uint index;\n"
    "flat out vec4 near_end;\n"
    "flat out vec3 far_end;\n"
    "flat out uint id;\n"
    "vec3 projected_disc(vec3 ball, float r)\n" /* centre and radius, samples */
    "{\n"
    "    if (projection.w != 0.0) {\n"
    "        return projection.z * vec3(ball.xy, r);\n"
    "    }\n"
    "    float d = ball.z * ball.z - r * r;\n"
    "    vec2 s = r * sqrt(ball.xy * ball.xy + d);\n"
    "    vec2 at = ball.xy / ball.z;\n"
    "    vec2 reach = max((ball.xy * ball.z + s) / d - at,\n"
    "                     at - (ball.xy * ball.z - s) / d);\n"
    "    return projection.z * vec3(at, length(reach));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec4 a = texelFetch(rods, 2 * int(index));\n"
    "    vec4 b = texelFetch(rods, 2 * int(index) + 1);\n"
    "    near_end = vec4(rotation * a.xyz + translation, a.w);\n"
    "    far_end = rotation * b.xyz + translation;\n"
    "    id = first + index;\n"
    "    vec3 from = projected_disc(near_end.xyz, a.w);\n"
    "    vec3 to = projected_disc(far_end, a.w);\n"
    "    vec2 along = to.xy - from.xy;\n"
    "    float size_along = length(along);\n"
    "    along = size_along > 1e-3 ? along / size_along : vec2(1.0, 0.0);\n"
    "    float half_width = 0.5 + max(from.z, to.z);\n"
    "    vec2 at = (gl_VertexID >> 1) == 0 ? from.xy - half_width * along\n"
    "                                      : to.xy + half_width * along;\n"
    "    at += ((gl_VertexID & 1) == 0 ? -half_width : half_width) *\n"
    "          vec2(-along.y, along.x);\n"
    "    vec2 pixel = projection.xy + vec2(at.x, -at.y);\n"
    "    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);\n"
    "}\n";

static const char rod_fragment[] =
    "#version 330 core\n" GLSL_CAMERA "flat in vec4 near_end;\n"
    "flat in vec3 far_end;\n"
    "flat in uint id;\n"
    "out uint seen;\n"
    "float cap(vec3 from, vec3 ray, float r)\n"
    "{\n"
    "    float a = dot(ray, ray);\n"
    "    float t = dot(from, ray) / a;\n"
    "    vec3 offset = from - t * ray;\n"
    "    float h = r * r - dot(offset, offset);\n"
    "    return h < 0.0 ? 1e30 : t - sqrt(h / a);\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec2 s = (gl_FragCoord.xy - projection.xy) /\n"
    "             vec2(projection.z, -projection.z);\n"
    "    bool flat_view = projection.w != 0.0;\n"
    "    vec3 ray = flat_view ? vec3(0.0, 0.0, 1.0) : vec3(s, 1.0);\n"
    "    vec3 from = flat_view ? vec3(s, 0.0) : vec3(0.0);\n"
    "    float start = dot(near_end.xyz - from, ray) / dot(ray, ray);\n"
    "    vec3 m = from + start * ray - near_end.xyz;\n"
    "    vec3 along = far_end - near_end.xyz;\n"
    "    float size = length(along);\n"
    "    vec3 u = along / max(size, 1e-6);\n"
    "    vec3 mp = m - dot(m, u) * u;\n"
    "    vec3 dp = ray - dot(ray, u) * u;\n"
    "    float a = dot(dp, dp);\n"
    "    float b = dot(mp, dp);\n"
    "    float h = b * b - a * (dot(mp, mp) - near_end.w * near_end.w);\n"
    "    float t = 1e30;\n"
    "    if (h >= 0.0 && a > 1e-12) {\n"
    "        float side = (-b - sqrt(h)) / a;\n"
    "        float axial = dot(m + side * ray, u);\n"
    "        if (axial >= 0.0 && axial <= size) {\n"
    "            t = side;\n"
    "        }\n"
    "    }\n"
    "    t = min(t, cap(-m, ray, near_end.w));\n"
    "    t = min(t, cap(along - m, ray, near_end.w));\n"
    "    if (t > 1e29) {\n"
    "        discard;\n"
    "    }\n"
    "    gl_FragDepth = (start + t - depth_range.x) / (depth_range.y - depth_range.x);\n"
    "    seen = id;\n"
    "}\n";

/* Triangles of a surface. */
static const char facet_vertex[] =
    "#version 330 core\n" GLSL_CAMERA "uniform vec2 size;\n"
    "uniform mat3 rotation;\n"
    "uniform vec3 translation;\n"
    "uniform uint first;\n"
    "layout(location = 0) in vec3 position;\n"
    "out float depth;\n"
    "flat out uint id;\n"
    "void main()\n"
    "{\n"
    "    vec3 at = rotation * position + translation;\n"
    "    float w = projection.w == 0.0 ? at.z : 1.0;\n"
    "    vec2 pixel = projection.xy + projection.z * vec2(at.x, -at.y) / w;\n"
    "    depth = at.z;\n"
    "    id = first + uint(gl_VertexID / 3);\n"
    "    gl_Position = vec4((2.0 * pixel / size - 1.0) * w, 0.0, w);\n"
    "}\n";

static const char facet_fragment[] = "#version 330 core\n" GLSL_CAMERA "in float depth;\n"
                                     "flat in uint id;\n"
                                     "out uint seen;\n"
                                     "void main()\n"
                                     "{\n"
                                     "    gl_FragDepth = clamp((depth - depth_range.x) / "
                                     "(depth_range.y - depth_range.x), 0.0, 1.0);\n"
                                     "    seen = id;\n"
                                     "}\n";

/* Ribbons made on the processor: position in samples, and depth.  In perspective it is
 * the inverse of the depth, which is linear along a straight line of the picture. */
static const char edge_vertex[] =
    "#version 330 core\n"
    "uniform vec2 size;\n"
    "layout(location = 0) in vec3 position;\n"
    "out float along;\n"
    "void main()\n"
    "{\n"
    "    along = position.z;\n"
    "    gl_Position = vec4(2.0 * position.xy / size - 1.0, 0.0, 1.0);\n"
    "}\n";

static const char edge_fragment[] =
    "#version 330 core\n" GLSL_CAMERA "in float along;\n"
    "out uint seen;\n"
    "void main()\n"
    "{\n"
    "    float depth = projection.w == 0.0 ? 1.0 / along : along;\n"
    "    float share = (depth - depth_range.x) / (depth_range.y - depth_range.x);\n"
    "    gl_FragDepth = clamp(share, 0.0, 1.0);\n"
    "    seen = 0xfffffffeu;\n"
    "}\n";

#define WHOLE_SCREEN                                                                     \
    "#version 330 core\n"                                                                \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : "        \
    "-1.0);\n"                                                                           \
    "    gl_Position = vec4(at, 0.0, 1.0);\n"                                            \
    "}\n"

/* Light: ambient light reduced by occlusion, a key light with soft shadows, a weak
 * highlight.  The occlusion is the share of a spiral of samples that lie above the
 * tangent plane and near the point.  Colours are linear.  The four samples of a pixel
 * rotate the spiral by quarters of its step: the pixel has four times as many
 * directions. */
static const char shade_fragment[] =
    "#version 330 core\n" GLSL_CAMERA GLSL_CUTS "uniform usampler2D seen;\n"
    "uniform sampler2D depths;\n"
    "uniform sampler2D shadows;\n"
    "uniform samplerBuffer spheres;\n"
    "uniform samplerBuffer rods;\n"
    "uniform samplerBuffer facets;\n"
    "uniform samplerBuffer colours;\n"
    "uniform uint first_rod;\n"
    "uniform uint first_facet;\n"
    "uniform vec2 size;\n"
    "uniform vec3 background;\n"
    "uniform vec3 foreground;\n"
    "uniform vec3 light;\n"
    "uniform vec3 sky;\n"
    "uniform float reach;\n"
    "uniform float reach_limit;\n"
    "uniform float cue;\n"
    "uniform mat3 light_rotation;\n"
    "uniform vec3 light_translation;\n"
    "uniform vec4 light_projection;\n"
    "uniform vec2 light_depth_range;\n"
    "uniform float shadow_share;\n"
    "uniform float detail;\n"
    "out vec4 colour;\n"
    "const int taps = 8;\n"
    "const int shadow_taps = 4;\n"
    "vec3 position_at(vec2 pixel, float depth)\n"
    "{\n"
    "    vec2 s = (pixel - projection.xy) / vec2(projection.z, -projection.z);\n"
    "    float w = depth_range.x + depth * (depth_range.y - depth_range.x);\n"
    "    return projection.w == 0.0 ? vec3(s * w, w) : vec3(s, w);\n"
    "}\n"
    "vec3 normal_at(vec3 p, uint id)\n"
    "{\n"
    "    if (id < first_rod) {\n"
    "        vec4 ball = texelFetch(spheres, int(id));\n"
    "        vec3 n = p - ball.xyz;\n"
    "        float face = length(n) < 0.998 * ball.w ? 1e30 : 0.0;\n"
    "        for (int k = 0; k < cuts && face > 0.0; k++) {\n" /* inside: on a cut */
    "            float away = abs(dot(cut[k].xyz, p) - cut[k].w);\n"
    "            n = away < face ? cut[k].xyz : n;\n"
    "            face = min(face, away);\n"
    "        }\n"
    "        return normalize(n);\n"
    "    }\n"
    "    if (id < first_facet) {\n"
    "        int k = 2 * int(id - first_rod);\n"
    "        vec3 a = texelFetch(rods, k).xyz;\n"
    "        vec3 u = texelFetch(rods, k + 1).xyz - a;\n"
    "        float share = clamp(dot(p - a, u) / max(dot(u, u), 1e-12), 0.0, 1.0);\n"
    "        return normalize(p - a - share * u);\n"
    "    }\n"
    "    int k = 3 * int(id - first_facet);\n"
    "    vec3 a = texelFetch(facets, k).xyz;\n"
    "    vec3 n = cross(texelFetch(facets, k + 1).xyz - a,\n"
    "                   texelFetch(facets, k + 2).xyz - a);\n"
    "    vec3 view = projection.w == 0.0 ? p : vec3(0.0, 0.0, 1.0);\n"
    "    return normalize(dot(n, view) > 0.0 ? -n : n);\n"
    "}\n"
    "float ambient(vec3 p, vec3 n, float rotation, mat2 spin)\n"
    "{\n"
    "    float scale = projection.w == 0.0 ? projection.z / p.z : projection.z;\n"
    "    float radius = min(reach * scale, reach_limit);\n"
    "    float bound = radius / scale;\n"
    "    float blocked = 0.0;\n"
    "    for (int k = 0; k < taps; k++) {\n"
    "        float u = (float(k) + 0.25 + 0.5 * rotation) / float(taps);\n"
    "        float angle = 2.39996 * float(k);\n"
    "        vec2 at = gl_FragCoord.xy +\n"
    "                  (1.0 + radius * u * sqrt(u)) *\n"
    "                  (spin * vec2(cos(angle), sin(angle)));\n"
    "        at = clamp(at, vec2(0.5), size - 0.5);\n"
    "        vec3 v = position_at(floor(at) + 0.5,\n"
    "                             texelFetch(depths, ivec2(at), 0).r) - p;\n"
    "        float closer = inversesqrt(dot(v, v) + 1e-12);\n"
    "        float near = clamp(1.5 - 1.5 / (bound * closer), 0.0, 1.0);\n"
    "        blocked += near * max(dot(v, n) * closer - 0.06, 0.0);\n"
    "    }\n"
    "    return clamp(1.0 - 2.6 * blocked / float(taps), 0.0, 1.0);\n"
    "}\n"
    "float unshadowed(vec3 p, vec3 n, float rotation, mat2 spin)\n"
    "{\n"
    "    vec3 q = light_rotation * (p + 0.04 * detail * n) + light_translation;\n"
    "    vec2 centre = light_projection.xy + light_projection.z * vec2(q.x, -q.y);\n"
    "    float depth = (q.z - light_depth_range.x) / (light_depth_range.y - "
    "light_depth_range.x);\n"
    "    float bias = 0.02 * detail / (light_depth_range.y - light_depth_range.x);\n"
    "    float half_width = 0.11 * detail * light_projection.z;\n"
    "    float unblocked = 0.0;\n"
    "    for (int k = 0; k < shadow_taps; k++) {\n"
    "        float angle = 2.39996 * float(k);\n"
    "        float r = half_width * sqrt((float(k) + rotation) / float(shadow_taps));\n"
    "        ivec2 at = ivec2(centre + r * (spin * vec2(cos(angle), sin(angle))));\n"
    "        unblocked += texelFetch(shadows, at, 0).r + bias >= depth ? 1.0 : 0.0;\n"
    "    }\n"
    "    return unblocked / float(shadow_taps);\n"
    "}\n";

static const char shade_main[] =
    "void main()\n"
    "{\n"
    "    uint id = texelFetch(seen, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    if (id == 0xffffffffu) {\n"
    "        discard;\n"
    "    }\n"
    "    float depth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    if (id == 0xfffffffeu) {\n"
    "        float fade = cue * smoothstep(0.0, 1.0, depth);\n"
    "        colour = vec4(mix(foreground, background, fade), 1.0);\n"
    "        return;\n"
    "    }\n"
    "    vec3 p = position_at(gl_FragCoord.xy, depth);\n"
    "    vec3 n = normal_at(p, id);\n"
    "    vec3 albedo = pow(texelFetch(colours, int(id)).rgb, vec3(2.2));\n"
    "    vec2 sub = mod(floor(gl_FragCoord.xy), 2.0);\n"
    "    float rotation = 0.25 * (sub.x + 2.0 * sub.y) + 0.125;\n"
    "    float c = cos(2.39996 * rotation);\n"
    "    float d = sin(2.39996 * rotation);\n"
    "    mat2 spin = mat2(c, d, -d, c);\n"
    "    float unblocked = ambient(p, n, rotation, spin);\n"
    "    float key = max(dot(n, light), 0.0);\n"
    "    float direct = mix(1.0, unshadowed(p, n, rotation, spin), shadow_share);\n"
    "    vec3 view = projection.w == 0.0 ? normalize(-p) : vec3(0.0, 0.0, -1.0);\n"
    "    float gloss = pow(max(dot(n, normalize(light + view)), 0.0), 28.0);\n"
    "    float dome = mix(0.55, 1.0, 0.5 + 0.5 * dot(n, sky));\n"
    "    vec3 warm = vec3(1.04, 1.0, 0.95);\n"
    "    vec3 cool = vec3(0.95, 0.99, 1.06);\n"
    "    vec3 sum = albedo * (0.66 * dome * unblocked * cool +\n"
    "                         0.86 * key * direct * warm);\n"
    "    sum += 0.09 * gloss * direct * unblocked;\n"
    "    colour = vec4(sum, 1.0);\n"
    "}\n";

/* Mean of the samples with a tent filter two pixels wide: anti-aliased box edges. */
static const char resolve_fragment[] =
    "#version 330 core\n"
    "uniform sampler2D samples;\n"
    "uniform ivec2 inset;\n"
    "out vec4 colour;\n"
    "vec3 encode(vec3 x)\n"
    "{\n"
    "    x = clamp(x, 0.0, 1.0);\n"
    "    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055,\n"
    "               step(vec3(0.0031308), x));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    ivec2 at = 2 * ivec2(gl_FragCoord.xy) + inset - 1;\n"
    "    const vec4 tent = vec4(0.125, 0.375, 0.375, 0.125);\n"
    "    vec4 sum = vec4(0.0);\n"
    "    for (int k = 0; k < 16; k++) {\n"
    "        vec4 one = texelFetch(samples, at + ivec2(k & 3, k >> 2), 0);\n"
    "        sum += tent[k & 3] * tent[k >> 2] * vec4(min(one.rgb, 1.0), one.a);\n"
    "    }\n"
    "    vec3 rgb = encode(sum.rgb / max(sum.a, 1e-6)) * sum.a;\n"
    "    colour = vec4(rgb, sum.a);\n"
    "}\n";

static const char wall_vertex[] =
    "#version 330 core\n" GLSL_CAMERA "uniform vec2 size;\n"
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
    "#version 330 core\n" GLSL_CAMERA GLSL_CUTS "uniform sampler2D depths;\n"
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

enum {
    TILE_WIDTH = 2048,   /* widest tile, pixels */
    TILE_AREA = 1 << 20, /* largest tile, pixels: bounds the memory */
    REACH_LIMIT = 192, /* longest range of the occlusion, and margin of a tile, samples */
};

enum {
    SAMPLES = 2,   /* a side, of one pixel */
    SHADOW = 1024, /* side of the shadow map */
    TEXTURES = 8,
    PROGRAMS = 7,
    BUFFERS = 8,
    ARRAYS = 5
};

/* Range of the ambient occlusion, mean diameters. */
#define OCCLUSION_REACH 3.0F

enum program {
    PROGRAM_SPHERE,
    PROGRAM_ROD,
    PROGRAM_FACET,
    PROGRAM_EDGE,
    PROGRAM_SHADE,
    PROGRAM_RESOLVE,
    PROGRAM_WALL
};

static const struct shader shaders[PROGRAMS] = {
    [PROGRAM_SPHERE] = {sphere_vertex, sphere_fragment, ""},
    [PROGRAM_ROD] = {rod_vertex, rod_fragment, ""},
    [PROGRAM_FACET] = {facet_vertex, facet_fragment, ""},
    [PROGRAM_EDGE] = {edge_vertex, edge_fragment, ""},
    [PROGRAM_SHADE] = {WHOLE_SCREEN, shade_fragment, shade_main},
    [PROGRAM_RESOLVE] = {WHOLE_SCREEN, resolve_fragment, ""},
    [PROGRAM_WALL] = {wall_vertex, wall_fragment, ""},
};

enum texture {
    TEXTURE_SEEN,
    TEXTURE_DEPTH,
    TEXTURE_SHADOW,
    TEXTURE_SPHERES,
    TEXTURE_COLOURS,
    TEXTURE_SAMPLES,
    TEXTURE_RODS,
    TEXTURE_FACETS
};
enum buffer {
    BUFFER_SPHERES,
    BUFFER_COLOURS,
    BUFFER_INDICES,
    BUFFER_RIBBONS,
    BUFFER_RODS,
    BUFFER_ROD_INDICES,
    BUFFER_FACETS,
    BUFFER_WALLS
};
enum array { ARRAY_SPHERES, ARRAY_RIBBONS, ARRAY_RODS, ARRAY_FACETS, ARRAY_WALLS };

/* One rendering of a scene: names of the GL objects, and the tile being rendered. */
struct pass {
    const struct gb_gl *gl;
    const GLuint *program; /* PROGRAMS */
    const struct gb_scene *scene;
    const struct gb_image *image;
    GLuint texture[TEXTURES];
    GLuint buffer[BUFFERS];
    GLuint frame[4]; /* seen, shadow, samples, pixels */
    GLuint pixels, array[ARRAYS];
    uint32_t *index;
    uint8_t *hidden; /* not visible to the viewer: spheres, then rods */
    uint8_t *unlit;  /* not reached by the light */
    struct gb_camera eye, light;
    int margin;              /* of a tile, samples */
    int x, y, width, height; /* tile, pixels */
    int most_width, most_height;
};

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Uniform variables of a GL program, by name. */

static void set_float(const struct gb_gl *gl, GLuint program, const char *name, float x)
{
    gl->Uniform1f(gl->GetUniformLocation(program, name), x);
}

static void set_vector(const struct gb_gl *gl, GLuint program, const char *name,
                       const float *x)
{
    gl->Uniform3fv(gl->GetUniformLocation(program, name), 1, x);
}

static void set_sampler(const struct gb_gl *gl, GLuint program, const char *name,
                        enum texture unit)
{
    gl->Uniform1i(gl->GetUniformLocation(program, name), (GLint)unit);
}

static void set_camera(const struct gb_gl *gl, GLuint program,
                       const struct gb_camera *camera, int width, int height)
{
    gl->Uniform4fv(gl->GetUniformLocation(program, "projection"), 1, camera->projection);
    gl->Uniform2fv(gl->GetUniformLocation(program, "depth_range"), 1,
                   camera->depth_range);
    gl->UniformMatrix3fv(gl->GetUniformLocation(program, "rotation"), 1, GL_FALSE,
                         camera->rotation);
    set_vector(gl, program, "translation", camera->translation);
    gl->Uniform2f(gl->GetUniformLocation(program, "size"), (float)width, (float)height);
}

/* The planes of the cut in the coordinates of a camera. */
static void set_cuts(const struct gb_gl *gl, GLuint program, const struct gb_scene *scene,
                     const struct gb_camera *camera)
{
    const float *m = camera->rotation;
    const float *t = camera->translation;
    float cut[3][4] = {{0.0F}};
    for (int i = 0; i < scene->cuts; i++) {
        const float *n = scene->cut[i];
        for (int k = 0; k < 3; k++) {
            cut[i][k] = m[k] * n[0] + m[3 + k] * n[1] + m[6 + k] * n[2];
        }
        cut[i][3] = n[3] + dot(cut[i], t);
    }
    gl->Uniform1i(gl->GetUniformLocation(program, "cuts"), scene->cuts);
    gl->Uniform4fv(gl->GetUniformLocation(program, "cut"), 3, &cut[0][0]);
}

static void set_eye(struct pass *pass)
{
    const struct gb_view *view = &pass->scene->view;
    struct gb_camera *camera = &pass->eye;
    *camera = (struct gb_camera){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int k = 0; k < 2; k++) {
        const int origin = k == 0 ? pass->x : pass->y;
        camera->projection[k] =
            (float)(SAMPLES * (view->centre[k] - origin) + pass->margin);
    }
    camera->projection[2] = (float)(SAMPLES * view->focal);
    camera->projection[3] = view->orthographic ? 1.0F : 0.0F;
    camera->depth_range[0] = (float)view->near;
    camera->depth_range[1] = (float)view->far;
}

/* Axes of the view from the light: rows of its rotation matrix. */
static void light_axes(const float light[3], float axis[3][3])
{
    const float size = sqrtf(dot(light, light));
    for (int k = 0; k < 3; k++) {
        axis[2][k] = -light[k] / size;
    }
    const float flat = hypotf(axis[2][0], axis[2][2]);
    axis[0][0] = axis[2][2] / flat;
    axis[0][1] = 0.0F;
    axis[0][2] = -axis[2][0] / flat;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        axis[1][k] = axis[2][i] * axis[0][j] - axis[2][j] * axis[0][i];
    }
}

/* Bounds of the scene in light coordinates. */
struct room {
    float axis[3][3], low[3], high[3];
};

static void widen(struct room *room, const float *point, float radius)
{
    for (int k = 0; k < 3; k++) {
        const float x = dot(point, room->axis[k]);
        room->low[k] = fminf(room->low[k], x - radius);
        room->high[k] = fmaxf(room->high[k], x + radius);
    }
}

/* Parallel light over the whole scene. */
static void set_light(struct pass *pass)
{
    const struct gb_scene *scene = pass->scene;
    struct gb_camera *camera = &pass->light;
    struct room room = {.low = {INFINITY, INFINITY, INFINITY},
                        .high = {-INFINITY, -INFINITY, -INFINITY}};
    light_axes(scene->light, room.axis);
    for (size_t i = 0; i < scene->count; i++) {
        widen(&room, &scene->sphere[4 * i], scene->sphere[4 * i + 3]);
    }
    for (size_t i = 0; i < 2 * scene->rods; i++) {
        widen(&room, &scene->rod[4 * i], scene->rod[8 * (i / 2) + 3]);
    }
    for (size_t i = 0; i < 3 * scene->facets; i++) {
        widen(&room, &scene->facet[3 * i], 0.0F);
    }
    if (!(room.low[0] <= room.high[0])) {
        for (int k = 0; k < 3; k++) {
            room.low[k] = -1.0F;
            room.high[k] = 1.0F;
        }
    }
    const float(*axis)[3] = (const float(*)[3])room.axis;
    const float *low = room.low;
    const float *high = room.high;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            camera->rotation[3 * j + k] = axis[k][j];
        }
        camera->translation[k] = k < 2 ? -0.5F * (low[k] + high[k]) : -low[k];
    }
    camera->projection[0] = camera->projection[1] = 0.5F * SHADOW;
    camera->projection[2] = 0.96F * SHADOW / fmaxf(high[0] - low[0], high[1] - low[1]);
    camera->projection[3] = 1.0F;
    camera->depth_range[0] = 0.0F;
    camera->depth_range[1] = high[2] - low[2];
}

static void new_texture(struct pass *pass, enum texture unit, GLint internal,
                        GLenum format, GLenum type, int width, int height)
{
    pass->gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    pass->gl->BindTexture(GL_TEXTURE_2D, pass->texture[unit]);
    pass->gl->TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, type,
                         NULL);
    pass->gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    pass->gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void attach(const struct pass *pass, GLuint frame, GLenum attachment,
                   GLuint texture)
{
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
    pass->gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
}

static void make_targets(struct pass *pass)
{
    const int width = SAMPLES * pass->most_width + 2 * pass->margin;
    const int height = SAMPLES * pass->most_height + 2 * pass->margin;
    pass->gl->GenTextures(TEXTURES, pass->texture);
    pass->gl->GenFramebuffers(4, pass->frame);
    new_texture(pass, TEXTURE_SEEN, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, width,
                height);
    new_texture(pass, TEXTURE_DEPTH, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT,
                width, height);
    new_texture(pass, TEXTURE_SHADOW, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT,
                SHADOW, SHADOW);
    new_texture(pass, TEXTURE_SAMPLES, GL_RGBA16F, GL_RGBA, GL_FLOAT, width, height);
    attach(pass, pass->frame[0], GL_COLOR_ATTACHMENT0, pass->texture[TEXTURE_SEEN]);
    attach(pass, pass->frame[0], GL_DEPTH_ATTACHMENT, pass->texture[TEXTURE_DEPTH]);
    attach(pass, pass->frame[1], GL_DEPTH_ATTACHMENT, pass->texture[TEXTURE_SHADOW]);
    pass->gl->DrawBuffer(GL_NONE);
    pass->gl->ReadBuffer(GL_NONE);
    attach(pass, pass->frame[2], GL_COLOR_ATTACHMENT0, pass->texture[TEXTURE_SAMPLES]);
    pass->gl->GenRenderbuffers(1, &pass->pixels);
    pass->gl->BindRenderbuffer(GL_RENDERBUFFER, pass->pixels);
    pass->gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, pass->most_width,
                                  pass->most_height);
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    pass->gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                      GL_RENDERBUFFER, pass->pixels);
}

static void make_table(struct pass *pass, int which, enum texture unit, GLenum format,
                       const void *data, size_t size)
{
    pass->gl->BindBuffer(GL_TEXTURE_BUFFER, pass->buffer[which]);
    pass->gl->BufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    pass->gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    pass->gl->BindTexture(GL_TEXTURE_BUFFER, pass->texture[unit]);
    pass->gl->TexBuffer(GL_TEXTURE_BUFFER, format, pass->buffer[which]);
}

/* One number per instance. */
static void bind_indices(const struct pass *pass, enum array array, enum buffer buffer)
{
    pass->gl->BindVertexArray(pass->array[array]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    pass->gl->VertexAttribIPointer(0, 1, GL_UNSIGNED_INT, 0, NULL);
    pass->gl->VertexAttribDivisor(0, 1);
    pass->gl->EnableVertexAttribArray(0);
}

/* One position per vertex. */
static void bind_positions(const struct pass *pass, enum array array, enum buffer buffer)
{
    pass->gl->BindVertexArray(pass->array[array]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    pass->gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    pass->gl->EnableVertexAttribArray(0);
}

static void make_inputs(struct pass *pass)
{
    const struct gb_scene *scene = pass->scene;
    const size_t parts = scene->count + scene->rods + scene->facets;
    pass->gl->GenBuffers(BUFFERS, pass->buffer);
    pass->gl->GenVertexArrays(ARRAYS, pass->array);
    make_table(pass, BUFFER_SPHERES, TEXTURE_SPHERES, GL_RGBA32F, scene->sphere,
               16 * (scene->count + 1));
    make_table(pass, BUFFER_COLOURS, TEXTURE_COLOURS, GL_RGBA8, scene->colour,
               4 * (parts + 1));
    make_table(pass, BUFFER_RODS, TEXTURE_RODS, GL_RGBA32F, scene->rod,
               32 * (scene->rods + 1));
    make_table(pass, BUFFER_FACETS, TEXTURE_FACETS, GL_RGB32F, scene->facet,
               36 * (scene->facets + 1));
    bind_indices(pass, ARRAY_SPHERES, BUFFER_INDICES);
    bind_indices(pass, ARRAY_RODS, BUFFER_ROD_INDICES);
    bind_positions(pass, ARRAY_RIBBONS, BUFFER_RIBBONS);
    bind_positions(pass, ARRAY_FACETS, BUFFER_FACETS);
}

static void free_buffers(struct pass *pass)
{
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    pass->gl->DeleteVertexArrays(ARRAYS, pass->array);
    pass->gl->DeleteBuffers(BUFFERS, pass->buffer);
    pass->gl->DeleteRenderbuffers(1, &pass->pixels);
    pass->gl->DeleteFramebuffers(4, pass->frame);
    pass->gl->DeleteTextures(TEXTURES, pass->texture);
}

enum { RIBBON = 6 }; /* vertices of a box edge */

/* Width of box edges as a share of the shorter side of the image. */
static const float edge_width = 0.0014F;

/* True if a sphere may cover a sample of the target; the factor 1.5 allows for the
 * elongation by perspective. */
static bool in_target(const struct gb_camera *camera, const float *ball, int width,
                      int height)
{
    const float scale = camera->projection[3] != 0.0F ? camera->projection[2]
                                                      : camera->projection[2] / ball[2];
    const float x = camera->projection[0] + scale * ball[0];
    const float y = camera->projection[1] - scale * ball[1];
    const float r = 1.5F * scale * ball[3] + 2.0F;
    return x + r >= 0.0F && y + r >= 0.0F && x - r <= (float)width &&
           y - r <= (float)height;
}

/* Whether a part within a ball needs to be drawn: spheres come first, then rods.  The
 * target of the light is the whole scene, that of the eye a tile. */
static bool shows(const struct pass *pass, const struct gb_camera *camera, size_t part,
                  const float *ball, int width, int height)
{
    return camera == &pass->light
               ? pass->unlit[part] == 0
               : pass->hidden[part] == 0 && in_target(camera, ball, width, height);
}

static void draw_spheres(struct pass *pass, const struct gb_camera *camera, int width,
                         int height)
{
    const GLuint program = pass->program[PROGRAM_SPHERE];
    GLsizei count = 0;
    for (size_t i = 0; i < pass->scene->count; i++) {
        if (shows(pass, camera, i, &pass->scene->sphere[4 * i], width, height)) {
            pass->index[count++] = (uint32_t)i;
        }
    }
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, camera, width, height);
    set_cuts(pass->gl, program, pass->scene, camera);
    set_sampler(pass->gl, program, "spheres", TEXTURE_SPHERES);
    pass->gl->BindVertexArray(pass->array[ARRAY_SPHERES]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[BUFFER_INDICES]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)count * 4, pass->index,
                         GL_STREAM_DRAW);
    pass->gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

static void set_first(const struct pass *pass, GLuint program, size_t first)
{
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first"), (GLuint)first);
}

/* Bounding ball of a rod around its first end. */
static void rod_ball(const float *rod, float ball[4])
{
    memcpy(ball, rod, 3 * sizeof *ball);
    ball[3] = rod[3] + hypotf(hypotf(rod[4] - rod[0], rod[5] - rod[1]), rod[6] - rod[2]);
}

static void draw_rods(struct pass *pass, const struct gb_camera *camera, int width,
                      int height)
{
    const GLuint program = pass->program[PROGRAM_ROD];
    const struct gb_scene *scene = pass->scene;
    GLsizei count = 0;
    for (size_t i = 0; i < scene->rods; i++) {
        float ball[4];
        rod_ball(&scene->rod[8 * i], ball);
        if (shows(pass, camera, scene->count + i, ball, width, height)) {
            pass->index[count++] = (uint32_t)i;
        }
    }
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, camera, width, height);
    set_sampler(pass->gl, program, "rods", TEXTURE_RODS);
    set_first(pass, program, scene->count);
    pass->gl->BindVertexArray(pass->array[ARRAY_RODS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[BUFFER_ROD_INDICES]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)count * 4, pass->index,
                         GL_STREAM_DRAW);
    pass->gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

static void draw_facets(const struct pass *pass, const struct gb_camera *camera,
                        int width, int height)
{
    const GLuint program = pass->program[PROGRAM_FACET];
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, camera, width, height);
    set_first(pass, program, pass->scene->count + pass->scene->rods);
    pass->gl->BindVertexArray(pass->array[ARRAY_FACETS]);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3 * (GLsizei)pass->scene->facets);
}

/* Spheres, rods and facets. */
static void draw_parts(struct pass *pass, const struct gb_camera *camera, int width,
                       int height)
{
    if (pass->scene->count > 0) {
        draw_spheres(pass, camera, width, height);
    }
    if (pass->scene->rods > 0) {
        draw_rods(pass, camera, width, height);
    }
    if (pass->scene->facets > 0) {
        draw_facets(pass, camera, width, height);
    }
}

/* Two triangles along an edge, in samples of the tile. */
static void ribbon(const struct gb_camera *camera, const float edge[6], float width,
                   float *out)
{
    static const int corner[RIBBON] = {0, 1, 2, 2, 1, 3};
    float end[2][3];
    for (int k = 0; k < 2; k++) {
        const float *p = &edge[3 * k];
        const bool flat = camera->projection[3] != 0.0F;
        const float scale = flat ? camera->projection[2] : camera->projection[2] / p[2];
        end[k][0] = camera->projection[0] + scale * p[0];
        end[k][1] = camera->projection[1] - scale * p[1];
        end[k][2] = flat ? p[2] : 1.0F / p[2];
    }
    const float dx = end[1][0] - end[0][0];
    const float dy = end[1][1] - end[0][1];
    const float half = 0.5F * width / fmaxf(hypotf(dx, dy), 1e-3F);
    for (int k = 0; k < RIBBON; k++) {
        const float *from = end[corner[k] >> 1];
        const float side = (corner[k] & 1) != 0 ? half : -half;
        const float past = corner[k] >> 1 != 0 ? half : -half; /* corners meet */
        out[3 * k] = from[0] - side * dy + past * dx;
        out[3 * k + 1] = from[1] + side * dx + past * dy;
        out[3 * k + 2] = from[2];
    }
}

static void draw_edges(struct pass *pass, int width, int height)
{
    const GLuint program = pass->program[PROGRAM_EDGE];
    const int side = pass->image->width < pass->image->height ? pass->image->width
                                                              : pass->image->height;
    const float thick = SAMPLES * fmaxf(edge_width * (float)side, 0.8F);
    float vertices[GB_SCENE_EDGES][3 * RIBBON];
    for (int k = 0; k < pass->scene->edge_count; k++) {
        ribbon(&pass->eye, pass->scene->edge[k], thick, vertices[k]);
    }
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, &pass->eye, width, height);
    pass->gl->BindVertexArray(pass->array[ARRAY_RIBBONS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[BUFFER_RIBBONS]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STREAM_DRAW);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, RIBBON * pass->scene->edge_count);
}

static void draw_shadow(struct pass *pass)
{
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[1]);
    pass->gl->Viewport(0, 0, SHADOW, SHADOW);
    pass->gl->Enable(GL_DEPTH_TEST);
    pass->gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_parts(pass, &pass->light, SHADOW, SHADOW);
}

static void draw_visible(struct pass *pass, int width, int height)
{
    static const GLuint no_particle[4] = {0xffffffffU, 0, 0, 0};
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[0]);
    pass->gl->Viewport(0, 0, width, height);
    pass->gl->Enable(GL_DEPTH_TEST);
    pass->gl->ClearBufferuiv(GL_COLOR, 0, no_particle);
    pass->gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_parts(pass, &pass->eye, width, height);
    draw_edges(pass, width, height);
}

/* sRGB byte to linear light. */
static float linear(uint8_t byte)
{
    const float x = (float)byte / 255.0F;
    return x <= 0.04045F ? x / 12.92F : powf((x + 0.055F) / 1.055F, 2.4F);
}

static void linear_colour(const uint8_t rgb[3], float out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = linear(rgb[k]);
    }
}

static void set_shade(const struct pass *pass, GLuint program, const float background[3])
{
    const struct gb_scene *scene = pass->scene;
    uint8_t rgb[3];
    float ink[3];
    float light[3];
    gb_scene_foreground(scene->background, rgb);
    linear_colour(rgb, ink);
    const float size = sqrtf(dot(scene->light, scene->light));
    for (int k = 0; k < 3; k++) {
        light[k] = scene->light[k] / size;
    }
    const float sky[3] = {(float)scene->view.right[2], (float)scene->view.up[2],
                          (float)scene->view.away[2]};
    set_vector(pass->gl, program, "background", background);
    set_vector(pass->gl, program, "foreground", ink);
    set_vector(pass->gl, program, "light", light);
    set_vector(pass->gl, program, "sky", sky);
    set_float(pass->gl, program, "reach", OCCLUSION_REACH * scene->diameter);
    set_float(pass->gl, program, "reach_limit", (float)pass->margin);
    set_float(pass->gl, program, "cue", scene->depth_cue);
    set_float(pass->gl, program, "shadow_share", scene->shadow_share);
    set_float(pass->gl, program, "detail", scene->diameter);
    pass->gl->UniformMatrix3fv(pass->gl->GetUniformLocation(program, "light_rotation"), 1,
                               GL_FALSE, pass->light.rotation);
    set_vector(pass->gl, program, "light_translation", pass->light.translation);
    pass->gl->Uniform4fv(pass->gl->GetUniformLocation(program, "light_projection"), 1,
                         pass->light.projection);
    pass->gl->Uniform2fv(pass->gl->GetUniformLocation(program, "light_depth_range"), 1,
                         pass->light.depth_range);
}

static void shade_samples(struct pass *pass, int width, int height)
{
    const GLuint program = pass->program[PROGRAM_SHADE];
    uint8_t rgb[3];
    float background[4];
    gb_scene_background(pass->scene->background, rgb);
    linear_colour(rgb, background);
    background[3] = 1.0F;
    static const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[2]);
    pass->gl->Disable(GL_DEPTH_TEST);
    pass->gl->ClearBufferfv(
        GL_COLOR, 0,
        pass->scene->background == GB_BACKGROUND_TRANSPARENT ? nothing : background);
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, &pass->eye, width, height);
    set_cuts(pass->gl, program, pass->scene, &pass->eye);
    set_sampler(pass->gl, program, "seen", TEXTURE_SEEN);
    set_sampler(pass->gl, program, "depths", TEXTURE_DEPTH);
    set_sampler(pass->gl, program, "shadows", TEXTURE_SHADOW);
    set_sampler(pass->gl, program, "spheres", TEXTURE_SPHERES);
    set_sampler(pass->gl, program, "rods", TEXTURE_RODS);
    set_sampler(pass->gl, program, "facets", TEXTURE_FACETS);
    set_sampler(pass->gl, program, "colours", TEXTURE_COLOURS);
    const size_t first_facet = pass->scene->count + pass->scene->rods;
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first_rod"),
                         (GLuint)pass->scene->count);
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first_facet"),
                         (GLuint)first_facet);
    set_shade(pass, program, background);
    /* the margin is read by the occlusion and not shaded */
    const int inset = pass->margin - SAMPLES;
    pass->gl->Enable(GL_SCISSOR_TEST);
    pass->gl->Scissor(MAX(inset, 0), MAX(inset, 0), width - 2 * MAX(inset, 0),
                      height - 2 * MAX(inset, 0));
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3);
    pass->gl->Disable(GL_SCISSOR_TEST);
}

static void read_pixels(struct pass *pass)
{
    const GLuint program = pass->program[PROGRAM_RESOLVE];
    const struct gb_image *image = pass->image;
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    pass->gl->Viewport(0, 0, pass->width, pass->height);
    pass->gl->UseProgram(program);
    set_sampler(pass->gl, program, "samples", TEXTURE_SAMPLES);
    pass->gl->Uniform2i(pass->gl->GetUniformLocation(program, "inset"), pass->margin,
                        pass->margin);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3);
    pass->gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    pass->gl->PixelStorei(GL_PACK_ROW_LENGTH, image->width);
    pass->gl->ReadPixels(
        0, 0, pass->width, pass->height, GL_RGBA, GL_UNSIGNED_BYTE,
        &image->rgba[4 * ((size_t)pass->y * (size_t)image->width + (size_t)pass->x)]);
}

enum { WALL_CORNER = GB_SCENE_WALL_NUMBERS / 3 };

/* Linear light of the walls, steel: on a light ground, on a dark one. */
static const float steel[2][3] = {{0.16F, 0.20F, 0.25F}, {0.45F, 0.52F, 0.60F}};

static void bind_walls(const struct pass *pass)
{
    static const GLint size[3] = {3, 3, 1};
    const GLsizei stride = WALL_CORNER * (GLsizei)sizeof(float);
    const GLsizeiptr bytes = (GLsizeiptr)(3 * pass->scene->walls) * stride;
    pass->gl->BindVertexArray(pass->array[ARRAY_WALLS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[BUFFER_WALLS]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, bytes, pass->scene->wall, GL_STREAM_DRAW);
    for (GLuint k = 0, first = 0; k < 3; first += (GLuint)size[k++]) {
        pass->gl->VertexAttribPointer(k, size[k], GL_FLOAT, GL_FALSE, stride,
                                      (const void *)(first * sizeof(float)));
        pass->gl->EnableVertexAttribArray(k);
    }
}

static void draw_walls(struct pass *pass, int width, int height)
{
    const GLuint program = pass->program[PROGRAM_WALL];
    const bool dark = pass->scene->background == GB_BACKGROUND_DARK;
    if (pass->scene->walls == 0) {
        return;
    }
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[2]);
    pass->gl->UseProgram(program);
    set_camera(pass->gl, program, &pass->eye, width, height);
    set_cuts(pass->gl, program, pass->scene, &pass->eye);
    set_sampler(pass->gl, program, "depths", TEXTURE_DEPTH);
    set_vector(pass->gl, program, "tint", steel[dark ? 1 : 0]);
    bind_walls(pass);
    pass->gl->Enable(GL_BLEND);
    pass->gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3 * (GLsizei)pass->scene->walls);
    pass->gl->Disable(GL_BLEND);
}

struct gb_renderer {
    struct gb_gl_context *context;
    GLuint program[PROGRAMS];
    GLint most_spheres;
};

static bool compile(const struct gb_gl *gl, GLuint program, GLenum stage,
                    const char *text, const char *more, struct gb_error *err)
{
    const char *const both[2] = {text, more};
    GLint done = 0;
    const GLuint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, 2, both, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == 0) {
        char log[200] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        gb_error_set(err, GB_ERR_MACHINE, "OpenGL refuses a shader: %s", log);
    }
    gl->AttachShader(program, shader);
    gl->DeleteShader(shader);
    return done != 0;
}

static bool build(const struct gb_gl *gl, GLuint *program, const struct shader *text,
                  struct gb_error *err)
{
    GLint done = 0;
    *program = gl->CreateProgram();
    if (!compile(gl, *program, GL_VERTEX_SHADER, text->vertex, "", err) ||
        !compile(gl, *program, GL_FRAGMENT_SHADER, text->fragment, text->more, err)) {
        return false;
    }
    gl->LinkProgram(*program);
    gl->GetProgramiv(*program, GL_LINK_STATUS, &done);
    return done != 0 || gb_error_set(err, GB_ERR_MACHINE, "OpenGL cannot link a shader");
}

bool gb_renderer_open(struct gb_renderer **out, struct gb_error *err)
{
    *out = NULL;
    struct gb_renderer *renderer = gb_alloc_array(1, sizeof *renderer, err);
    if (renderer == NULL) {
        return false;
    }
    if (!gb_gl_context_open(&renderer->context, err)) {
        goto fail;
    }
    const struct gb_gl *gl = gb_gl_context_functions(renderer->context);
    for (int k = 0; k < PROGRAMS; k++) {
        if (!build(gl, &renderer->program[k], &shaders[k], err)) {
            goto fail;
        }
    }
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &renderer->most_spheres);
    *out = renderer;
    return true;
fail:
    gb_renderer_close(renderer);
    return false;
}

void gb_renderer_close(struct gb_renderer *renderer)
{
    if (renderer != NULL) {
        gb_gl_context_close(renderer->context);
        gb_alloc_free(renderer);
    }
}

static void paint_tile(struct pass *pass)
{
    const int width = SAMPLES * pass->width + 2 * pass->margin;
    const int height = SAMPLES * pass->height + 2 * pass->margin;
    set_eye(pass);
    draw_visible(pass, width, height);
    shade_samples(pass, width, height);
    draw_walls(pass, width, height);
    read_pixels(pass);
}

/* Samples around a tile that its occlusion reads; even, as pixels are 2 x 2. */
static int tile_margin(const struct gb_scene *scene)
{
    const double near = scene->view.orthographic ? 1.0 : scene->view.near;
    const double reach = SAMPLES * scene->view.focal / near * (double)OCCLUSION_REACH;
    return 2 * (int)ceil(0.5 * fmin(reach, REACH_LIMIT));
}

static bool gl_failed(const struct gb_gl *gl, struct gb_error *err)
{
    const GLenum code = gl->GetError();
    if (code == GL_NO_ERROR) {
        return false;
    }
    gb_error_set(err, code == GL_OUT_OF_MEMORY ? GB_ERR_MEMORY : GB_ERR_MACHINE,
                 "OpenGL cannot paint the picture (error 0x%x)", code);
    return true;
}

/* Length of equal pieces of at most `most` that cover a side. */
static int tile_size(int side, int most)
{
    const int tiles = (side + most - 1) / most;
    return (side + tiles - 1) / tiles;
}

static void free_lists(struct pass *pass)
{
    gb_alloc_free(pass->index);
    gb_alloc_free(pass->hidden);
    gb_alloc_free(pass->unlit);
}

/* Scratch of draw lists, and the particles that no draw list needs. */
static bool make_lists(struct pass *pass, struct gb_error *err)
{
    const struct gb_scene *scene = pass->scene;
    const size_t parts = scene->count + scene->rods;
    const int width = SAMPLES * pass->image->width;
    const int height = SAMPLES * pass->image->height;
    pass->index =
        gb_alloc_array(MAX(scene->count, scene->rods) + 1, sizeof *pass->index, err);
    pass->hidden = gb_alloc_array(parts + 1, 1, err);
    pass->unlit = gb_alloc_array(parts + 1, 1, err);
    if (pass->index == NULL || pass->hidden == NULL || pass->unlit == NULL) {
        return false;
    }
    set_eye(pass); /* of the whole image: no tile and no margin yet */
    set_light(pass);
    return gb_hidden_find(scene, &pass->eye, width, height, pass->hidden, err) &&
           gb_hidden_find(scene, &pass->light, SHADOW, SHADOW, pass->unlit, err);
}

bool gb_renderer_render(struct gb_renderer *renderer, const struct gb_scene *scene,
                        struct gb_image *image, struct gb_error *err)
{
    struct pass pass = {.gl = gb_gl_context_functions(renderer->context),
                        .program = renderer->program,
                        .scene = scene,
                        .image = image};
    const size_t parts = scene->count + 2 * scene->rods + 3 * scene->facets;
    if (parts > (size_t)renderer->most_spheres) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "a picture of %zu particles and %zu forces: at most %d of "
                            "both",
                            scene->count, scene->rods / 2, renderer->most_spheres);
    }
    if (!gb_gl_context_use(renderer->context, err)) {
        return false;
    }
    if (!make_lists(&pass, err)) {
        free_lists(&pass);
        return false;
    }
    pass.margin = tile_margin(scene);
    pass.most_width = tile_size(image->width, TILE_WIDTH);
    pass.most_height = tile_size(image->height, TILE_AREA / pass.most_width);
    make_targets(&pass);
    make_inputs(&pass);
    bool failed = gl_failed(pass.gl, err);
    if (!failed) {
        draw_shadow(&pass);
    }
    for (pass.y = 0; pass.y < image->height && !failed; pass.y += pass.most_height) {
        pass.height = MIN(pass.most_height, image->height - pass.y);
        for (pass.x = 0; pass.x < image->width && !failed; pass.x += pass.most_width) {
            pass.width = MIN(pass.most_width, image->width - pass.x);
            paint_tile(&pass);
            failed = gl_failed(pass.gl, err);
        }
    }
    free_buffers(&pass);
    free_lists(&pass);
    return !failed;
}
