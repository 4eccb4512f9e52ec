#include "draw/shaders.h"

/* lens: pixel of the axis, focal length in samples, 1 when orthographic.
 * range: depth of 0 and of 1 in the depth buffer, which is linear. */
#define LENS "uniform vec4 lens;\nuniform vec2 range;\n"

/* A ray meets a sphere.  Measured from the point of the ray nearest to the centre: the
 * plain quadratic loses all digits when the viewer is many diameters away. */
static const char sphere_vertex[] =
    "#version 330 core\n" LENS
    "uniform samplerBuffer spheres;\n"
    "uniform vec2 size;\n"
    "uniform mat3 turn;\n"
    "uniform vec3 shift;\n"
    "layout(location = 0) in uint index;\n"
    "flat out vec4 ball;\n"
    "flat out uint id;\n"
    "void main()\n"
    "{\n"
    "    vec4 raw = texelFetch(spheres, int(index));\n"
    "    ball = vec4(turn * raw.xyz + shift, raw.w);\n"
    "    id = index;\n"
    "    vec2 low = ball.xy - ball.w;\n"
    "    vec2 high = ball.xy + ball.w;\n"
    "    if (lens.w == 0.0) {\n"
    "        float d = ball.z * ball.z - ball.w * ball.w;\n"
    "        vec2 s = ball.w * sqrt(ball.xy * ball.xy + d);\n"
    "        low = (ball.xy * ball.z - s) / d;\n"
    "        high = (ball.xy * ball.z + s) / d;\n"
    "    }\n"
    "    vec2 at = mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1));\n"
    "    vec2 pixel = lens.xy + lens.z * vec2(at.x, -at.y);\n"
    "    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);\n"
    "}\n";

static const char sphere_fragment[] =
    "#version 330 core\n" LENS
    "flat in vec4 ball;\n"
    "flat in uint id;\n"
    "out uint seen;\n"
    "void main()\n"
    "{\n"
    "    vec2 s = (gl_FragCoord.xy - lens.xy) / vec2(lens.z, -lens.z);\n"
    "    vec3 ray = lens.w == 0.0 ? vec3(s, 1.0) : vec3(0.0, 0.0, 1.0);\n"
    "    vec3 to = lens.w == 0.0 ? ball.xyz : ball.xyz - vec3(s, 0.0);\n"
    "    float a = dot(ray, ray);\n"
    "    float t = dot(to, ray) / a;\n"
    "    vec3 miss = to - t * ray;\n"
    "    float h = ball.w * ball.w - dot(miss, miss);\n"
    "    if (h < 0.0) {\n"
    "        discard;\n"
    "    }\n"
    "    float depth = t - sqrt(h / a);\n"
    "    gl_FragDepth = (depth - range.x) / (range.y - range.x);\n"
    "    seen = id;\n"
    "}\n";

/* Ribbons made on the processor: place in samples, and depth (its inverse in perspective,
 * which is what changes evenly along a straight line of the picture). */
static const char edge_vertex[] =
    "#version 330 core\n"
    "uniform vec2 size;\n"
    "layout(location = 0) in vec3 place;\n"
    "out float along;\n"
    "void main()\n"
    "{\n"
    "    along = place.z;\n"
    "    gl_Position = vec4(2.0 * place.xy / size - 1.0, 0.0, 1.0);\n"
    "}\n";

static const char edge_fragment[] =
    "#version 330 core\n" LENS
    "in float along;\n"
    "out uint seen;\n"
    "void main()\n"
    "{\n"
    "    float depth = lens.w == 0.0 ? 1.0 / along : along;\n"
    "    gl_FragDepth = clamp((depth - range.x) / (range.y - range.x), 0.0, 1.0);\n"
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

/* Light: an even sky that the neighbours block (occlusion: share of a spiral of samples
 * that stands above the tangent plane and near), a key light with soft shadows, a weak
 * highlight.  Colours are linear here.  The four samples of a pixel turn the spiral by
 * quarters of its step, so that a pixel sees four times as many directions. */
static const char shade_fragment[] =
    "#version 330 core\n" LENS "uniform usampler2D seen;\n"
    "uniform sampler2D depths;\n"
    "uniform sampler2D shadows;\n"
    "uniform samplerBuffer spheres;\n"
    "uniform samplerBuffer colours;\n"
    "uniform vec2 size;\n"
    "uniform vec3 ground;\n"
    "uniform vec3 ink;\n"
    "uniform vec3 light;\n"
    "uniform vec3 sky;\n"
    "uniform float reach;\n"
    "uniform float reach_limit;\n"
    "uniform float cue;\n"
    "uniform mat3 light_turn;\n"
    "uniform vec3 light_shift;\n"
    "uniform vec4 light_lens;\n"
    "uniform vec2 light_range;\n"
    "uniform float shadow_share;\n"
    "out vec4 colour;\n"
    "const int taps = 16;\n"
    "const int shadow_taps = 6;\n"
    "vec3 place(vec2 pixel, float depth)\n"
    "{\n"
    "    vec2 s = (pixel - lens.xy) / vec2(lens.z, -lens.z);\n"
    "    float w = range.x + depth * (range.y - range.x);\n"
    "    return lens.w == 0.0 ? vec3(s * w, w) : vec3(s, w);\n"
    "}\n"
    "float open_sky(vec3 p, vec3 n, float turn)\n"
    "{\n"
    "    float scale = lens.w == 0.0 ? lens.z / p.z : lens.z;\n"
    "    float radius = min(reach * scale, reach_limit);\n"
    "    float bound = radius / scale;\n"
    "    float blocked = 0.0;\n"
    "    for (int k = 0; k < taps; k++) {\n"
    "        float u = (float(k) + 0.25 + 0.5 * turn) / float(taps);\n"
    "        float angle = 2.39996 * (float(k) + turn);\n"
    "        vec2 at = gl_FragCoord.xy +\n"
    "                  (1.0 + radius * pow(u, 1.5)) * vec2(cos(angle), sin(angle));\n"
    "        at = clamp(at, vec2(0.5), size - 0.5);\n"
    "        vec3 v = place(floor(at) + 0.5, texelFetch(depths, ivec2(at), 0).r) - p;\n"
    "        float d = length(v) + 1e-6;\n"
    "        float near = clamp(1.5 - 1.5 * d / bound, 0.0, 1.0);\n"
    "        blocked += near * max(dot(v, n) / d - 0.06, 0.0);\n"
    "    }\n"
    "    return clamp(1.0 - 2.6 * blocked / float(taps), 0.0, 1.0);\n"
    "}\n"
    "float lit(vec3 p, vec3 n, float turn)\n"
    "{\n"
    "    vec3 q = light_turn * (p + 0.04 * n) + light_shift;\n"
    "    vec2 centre = light_lens.xy + light_lens.z * vec2(q.x, -q.y);\n"
    "    float depth = (q.z - light_range.x) / (light_range.y - light_range.x);\n"
    "    float bias = 0.02 / (light_range.y - light_range.x);\n"
    "    float open = 0.0;\n"
    "    for (int k = 0; k < shadow_taps; k++) {\n"
    "        float angle = 2.39996 * (float(k) + turn);\n"
    "        float r = 0.11 * light_lens.z * sqrt((float(k) + turn) / "
    "float(shadow_taps));\n"
    "        ivec2 at = ivec2(centre + r * vec2(cos(angle), sin(angle)));\n"
    "        open += texelFetch(shadows, at, 0).r + bias >= depth ? 1.0 : 0.0;\n"
    "    }\n"
    "    return open / float(shadow_taps);\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    uint id = texelFetch(seen, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    if (id == 0xffffffffu) {\n"
    "        discard;\n"
    "    }\n"
    "    float depth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    float fade = cue * smoothstep(0.0, 1.0, depth);\n"
    "    if (id == 0xfffffffeu) {\n"
    "        colour = vec4(mix(ink, ground, 1.3 * fade), 1.0);\n"
    "        return;\n"
    "    }\n"
    "    vec4 ball = texelFetch(spheres, int(id));\n"
    "    vec3 p = place(gl_FragCoord.xy, depth);\n"
    "    vec3 n = normalize(p - ball.xyz);\n"
    "    vec3 albedo = pow(texelFetch(colours, int(id)).rgb, vec3(2.2));\n"
    "    vec2 sub = mod(floor(gl_FragCoord.xy), 2.0);\n"
    "    float turn = 0.25 * (sub.x + 2.0 * sub.y) + 0.125;\n"
    "    float open = open_sky(p, n, turn);\n"
    "    float key = max(dot(n, light), 0.0);\n"
    "    float shine = mix(1.0, lit(p, n, turn), shadow_share);\n"
    "    vec3 view = lens.w == 0.0 ? normalize(-p) : vec3(0.0, 0.0, -1.0);\n"
    "    float gloss = pow(max(dot(n, normalize(light + view)), 0.0), 28.0);\n"
    "    float dome = mix(0.55, 1.0, 0.5 + 0.5 * dot(n, sky));\n"
    "    vec3 warm = vec3(1.04, 1.0, 0.95);\n"
    "    vec3 cool = vec3(0.95, 0.99, 1.06);\n"
    "    vec3 sum = albedo * (0.66 * dome * open * cool + 0.86 * key * shine * warm);\n"
    "    sum += 0.09 * gloss * shine * open;\n"
    "    colour = vec4(mix(sum, ground, fade), 1.0);\n"
    "}\n";

/* Samples to pixels by a tent two pixels wide: box edges without steps. */
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

const struct gb_shaders_text gb_shaders_sphere = {sphere_vertex, sphere_fragment};
const struct gb_shaders_text gb_shaders_edge = {edge_vertex, edge_fragment};
const struct gb_shaders_text gb_shaders_shade = {WHOLE_SCREEN, shade_fragment};
const struct gb_shaders_text gb_shaders_resolve = {WHOLE_SCREEN, resolve_fragment};
