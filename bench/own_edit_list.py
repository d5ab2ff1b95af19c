# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Edits of the kernels as maintainers make them, for bench/own_edits.py.

Each edit is a name, its kind and a list of steps (file, text that stands there once, text in its place). A step is done
alike in both cores, which makes each core's text the other one's oracle: `bsdf` is bsdf.glsl there and bsdf.h here, `@`
before a function's head is nothing there and `inline ` here, `#include <bsdf>` is written as each side writes it. A file
of one core alone is named in full, one of both beside the kernels with `core:`. An old text of None makes a new file.
"""

SMALL = [
    # Constants.
    ("float literal", "constant", [("shade", "max_component(weight), 0.05f", "max_component(weight), 0.1f")]),
    ("hash constant", "constant", [("random", "hash_bits(b) + 0x9e3779b9u", "hash_bits(b) + 0x7f4a7c15u")]),
    ("constant of a file", "constant", [("bsdf", "COAT_F0 = 0.04f", "COAT_F0 = 0.05f")]),
    ("constant of pairs", "constant", [("random", "PAIRS_PER_VERTEX = 5u", "PAIRS_PER_VERTEX = 6u")]),
    ("two constants of one scale", "constant",
     [("random", "Float(bits >> 8) * 5.9604644775390625e-8f", "Float(bits >> 9) * 1.1920928955078125e-7f")]),
    # Operators and operands.
    ("comparison", "operator", [("shade", "pass.segment >= 3u", "pass.segment > 3u")]),
    ("and for or", "operator", [("shade", "surface.front || double_sided", "surface.front && double_sided")]),
    ("division for a product", "operator", [("intersect", "test.u = weight1 * scale;", "test.u = weight1 / sum;")]),
    ("sign", "operator", [("lights", "Float cosine = -dot(vec3(axis_row), light.direction);",
                           "Float cosine = dot(vec3(axis_row), light.direction);")]),
    ("other order of a sum", "operands",
     [("generate", "(vec3(settings.screen) + vec3(settings.screen_right) * x) + vec3(settings.screen_down) * y",
       "vec3(settings.screen) + (vec3(settings.screen_right) * x + vec3(settings.screen_down) * y)")]),
    ("arguments swapped", "operands", [("sky", "return blend(upper, lower, y - top);", "return blend(lower, upper, y - top);")]),
    ("difference turned round", "operands", [("motion", "then.y - now.y", "now.y - then.y")]),
    ("component", "operands", [("material", "sample_slot(floatBitsToUint(more.y), surface.coordinates).w",
                                "sample_slot(floatBitsToUint(more.y), surface.coordinates).x")]),
    ("arms of a select", "select", [("lights", "select(kind == LIGHT_SPOT, inside, Float(1.0f))",
                                     "select(kind != LIGHT_SPOT, Float(1.0f), square(inside))")]),
    ("arm of a ternary", "select", [("filter", "right == 0 || down == 0 ? alike : alike * 0.5f, Float", "right == 0 && down == 0 ? alike : alike * 0.25f, Float")]),
    # Terms.
    ("added factor", "term", [("guide", "color + gloss + vec3(0.01f)", "color + gloss * 0.5f + vec3(0.01f)")]),
    ("added term over lines", "term",
     [("bsdf", "    Float shadows = 1.0f + bsdf.sheen_shadow + sheen_shadow(saturate(wi.z), bsdf.sheen_roughness);",
       "    Float shadows = 1.0f + bsdf.sheen_shadow + sheen_shadow(saturate(wi.z), bsdf.sheen_roughness) +\n"
       "                    bsdf.sheen_strength * square(1.0f - saturate(wi.z));")]),
    ("removed term", "term", [("reproject", " + sqrt(memory.variance) + ", " + ")]),
    # Statements.
    ("removed statement", "removed",
     [("surface", "    cover = min(cover, 1.0e20f);  // times no area at all, infinity would be no number\n", "")]),
    ("removed one of several alike", "removed",
     [("lights", "        light.distance = select(punctual, other.distance, light.distance);\n", "")]),
    ("removed block", "removed",
     [("lights", "    if (has_feature(FEATURE_SKY_MAP)) {\n        Mask sky = kind == LIGHT_SKY;\n"
       "        LightSample other = sample_sky_light(u, random_pair(stream, sample_index, first_pair + PAIR_SKY_PICK));\n"
       "        light.direction = select(sky, other.direction, light.direction);\n"
       "        light.distance = select(sky, other.distance, light.distance);\n"
       "        light.radiance = select(sky, other.radiance, light.radiance);\n"
       "        light.pdf = select(sky, fetch_light_table(chosen).z * other.pdf, light.pdf);\n    }\n", "")]),
    ("one of a series gone", "removed", [("math", "    p = p * a + 0.0308918810f;\n", "")]),
    ("one more of a series", "added", [("random", "    x = x * 0x846ca68bu;\n", "    x = x * 0x846ca68bu;\n    x = x ^ (x >> 13);\n")]),
    ("one more in the middle of a series", "added",
     [("math", "    p = p * t2 + 0.0429096138f;\n", "    p = p * t2 + 0.0429096138f;\n    p = p * t2 - 0.0633333333f;\n")]),
    ("moved statement", "moved",
     [("shade", "    shade_emission(path, direction, surface, material, throughput);\n    if (settings.scene_extent.w", "    if (settings.scene_extent.w"),
      ("shade", "    Uint medium = 0u;\n", "    shade_emission(path, direction, surface, material, throughput);\n    Uint medium = 0u;\n")]),
    ("statement into a block", "moved",
     [("shade", "    vec3 direction = to_world(scatterer.frame, bsdf_sample.wi);\n", ""),
      ("shade", "    vec2 u = random_pair(stream, pass.sample_index, first_pair + PAIR_BSDF);\n    Float lobe",
       "    vec2 u = random_pair(stream, pass.sample_index, first_pair + PAIR_BSDF + PAIR_LOBE);\n    Float lobe"),
      ("shade", "    PathRay next;\n", "    PathRay next;\n    vec3 direction = normalized(to_world(scatterer.frame, bsdf_sample.wi));\n")]),
    ("new local", "local", [("bsdf", "    Float m2 = m * m;\n    return m2 * m2 * m;", "    Float m2 = m * m;\n    Float m4 = m2 * m2;\n    return m4 * m;")]),
    ("new local in two places", "local",
     [("texture", "    Float left = floor(x);\n    Float top = floor(y);\n    Float fraction_x = select(nearest, floor((x - left) + 0.5f), x - left);\n"
       "    Float fraction_y = select(nearest, floor((y - top) + 0.5f), y - top);",
       "    Float left = floor(x);\n    Float top = floor(y);\n    Float bias = select(nearest, Float(0.5f), Float(0.25f));\n"
       "    Float fraction_x = select(nearest, floor((x - left) + bias), x - left);\n"
       "    Float fraction_y = select(nearest, floor((y - top) + bias), y - top);")]),
    ("local of another type", "local", [("filter", "    Float kept = max(1.0f - 12.0f * doubt", "    Float kept = 1.0f - min(12.0f * doubt"),
                                        ("filter", "(dot(off, off) + 1.0e-12f), 0.0f);", "(dot(off, off) + 1.0e-12f), 1.0f);")]),
    # Conditions and blocks.
    ("changed condition", "condition", [("lights", "facing > 0.0f || two_sided", "facing > 1.0e-6f || two_sided")]),
    ("one more condition", "condition", [("path_state", "settings.indirect_limit > 0.0f && segments >= 3u",
                                          "settings.indirect_limit > 0.0f && segments >= 3u && settings.motion == STANDS_STILL")]),
    ("condition of a loop", "condition", [("coincident", "looking && !taken && row < partners.end", "looking && row < partners.end")]),
    ("bound of two loops", "loop",
     [("reproject", "    for (int down = -1; down <= 1; ++down) {\n        for (int across = -1; across <= 1; ++across) {",
       "    for (int down = -2; down <= 2; ++down) {\n        for (int across = -2; across <= 2; ++across) {")]),
    ("new if", "new if",
     [("shade", "        Float light_pdf = density * surface.distance_squared / cosine;\n",
       "        Float light_pdf = density * surface.distance_squared / cosine;\n        if (settings.light_count > 1u) {\n"
       "            light_pdf = light_pdf * 0.5f;\n        }\n")]),
    ("new else", "new if",
     [("finalize", "        sum = vec3(load_accumulator(pixel)) + radiance;\n    }\n",
       "        sum = vec3(load_accumulator(pixel)) + radiance;\n    } else {\n        sum = sum * 0.5f;\n    }\n")]),
    ("guard around what is there", "guard",
     [("extend", "    SkyLookup sky = look_up_sky(direction);\n    add_radiance(path, throughput.weight * sky.radiance * found_by_chance(throughput, sky.pdf), where);\n",
       "    if (any_lane(where)) {\n        SkyLookup sky = look_up_sky(direction);\n"
       "        add_radiance(path, throughput.weight * sky.radiance * found_by_chance(throughput, sky.pdf), where);\n    }\n")]),
    ("guard taken away", "guard",
     [("texture", "    if (any_lane(fraction > 0.0f)) {\n        vec4 coarser = sample_level(header, min(Uint(finer) + 1u, header.z - 1u), uv);\n"
       "        color = select(fraction > 0.0f, blend(color, coarser, fraction), color);\n    }\n",
       "    vec4 coarser = sample_level(header, min(Uint(finer) + 1u, header.z - 1u), uv);\n    color = blend(color, coarser, fraction);\n")]),
    ("early guard", "guard",
     [("alpha", "    Float coverage = opacity;\n    if (has_feature", "    if (!has_feature(FEATURE_ALPHA)) {\n        return opacity > 0.0f;\n    }\n    Float coverage = opacity;\n    if (has_feature")]),
    # Calls.
    ("changed call", "call", [("bsdf", "cosine + lobe_root(bsdf, wi), SMALLEST", "cosine + smith_root(cosine, bsdf.alpha), SMALLEST")]),
    ("call around an expression", "call", [("bsdf", "    return 1.0f - bsdf.passing * (1.0f - dielectric_reflectance(bsdf, weight));",
                                            "    return saturate(1.0f - bsdf.passing * (1.0f - dielectric_reflectance(bsdf, weight)));")]),
    ("call of a function of another file", "call",
     [("guide", "    normal = select(surface.front, normal, -normal);", "    normal = mirrored(select(surface.front, normal, -normal), surface.geometric_normal);")]),
    # Names and order.
    ("renamed function", "rename", [("shade", "Float cone_growth(Bsdf", "Float cone_opening(Bsdf"), ("shade", "+ cone_growth(scatterer", "+ cone_opening(scatterer")]),
    ("renamed function of three files", "rename",
     [("random", "Float unit_float(Uint bits)", "Float unit_number(Uint bits)"), ("random", "vec2(unit_float(x), unit_float(y))", "vec2(unit_number(x), unit_number(y))"),
      ("bsdf", "vec2(unit_float(hash_bits(y ^ 0x5851f42du)), unit_float(hash_bits(", "vec2(unit_number(hash_bits(y ^ 0x5851f42du)), unit_number(hash_bits("),
      ("alpha", "unit_float(hash_pair(key", "unit_number(hash_pair(key")]),
    ("renamed constant of layout.h", "rename",
     [("layout", "const uint INSTANCES_MOVE = 2u;", "const uint SOME_INSTANCE_MOVES = 2u;"), ("motion", ">= INSTANCES_MOVE", ">= SOME_INSTANCE_MOVES"),
      ("core:render_core.cpp", "INSTANCES_MOVE", "SOME_INSTANCE_MOVES")]),
    ("renamed field", "rename",
     [("sky", "    Float pdf;  // per solid angle, of choosing", "    Float density;  // per solid angle, of choosing"), ("sky", "    sky.pdf = 0.0f;", "    sky.density = 0.0f;"),
      ("sky", "sky.pdf = settings", "sky.density = settings"), ("extend", "throughput, sky.pdf)", "throughput, sky.density)")]),
    ("order of fields", "fields", [("path_state", "    Float cone_width;\n    Float cone_spread;\n", "    Float cone_spread;\n    Float cone_width;\n")]),
    ("type of a parameter", "type", [("filter", "Float weight_of(Float alike) {\n    Float left = max(alike, 0.0f);", "vec3 weight_of(vec3 alike) {\n    vec3 left = max(alike, vec3(0.0f));")]),
    # Where nothing is due.
    ("comment", "nothing", [("shade", "// Cone growth by scattering: mirrors keep the cone", "// By scattering: mirrors keep the cone")], "source"),
    ("line breaks", "nothing", [("extend", "    Hit hit = trace_closest(path_ray.ray, path);", "    Hit hit =\n        trace_closest(path_ray.ray, path);")], "source"),
    ("literal's spelling", "nothing", [("shade", "bent, towards) > 1.0e-3f", "bent, towards) > 0.001f")], "source"),
    ("local renamed", "nothing", [("filter", "    Float left = max(alike, 0.0f);\n    return left * left;", "    Float rest = max(alike, 0.0f);\n    return rest * rest;")], "source"),
]

HAZE_EVALUATE = """// A second, wide lobe of what a polished surface scatters around its mirror direction.
@BsdfValue evaluate_haze(Bsdf bsdf, vec3 wi) {
    vec3 h = normalized(bsdf.wo + wi);
    Float root_i = smith_root(wi.z, bsdf.haze_alpha);
    Float density = ggx_density(h, bsdf.haze_alpha);
    Float visible = 0.5f / max(bsdf.wo.z * root_i + wi.z * bsdf.haze_root_o, SMALLEST);
    Mask returns = wi.z > 0.0f && dot(bsdf.side, wi) > 0.0f;
    BsdfValue result;
    result.value = select(returns, bsdf.f0 * (bsdf.haze * density * visible * wi.z), vec3(0.0f));
    Float chosen = bsdf.pick_haze * density * 0.5f / (bsdf.wo.z + bsdf.haze_root_o);
    result.pdf = select(returns, chosen, Float(0.0f));
    return result;
}

"""

LARGE = [
    ("parameter through three functions", "parameter",
     [("intersect", "@Float offset_component(Float p, Float n) {\n    Int steps = Int(256.0f * n);",
       "@Float offset_component(Float p, Float n, Float scale) {\n    Int steps = Int(256.0f * scale * n);"),
      ("intersect", "@vec3 offset_point(vec3 p, vec3 normal) {\n"
       "    return vec3(offset_component(p.x, normal.x), offset_component(p.y, normal.y), offset_component(p.z, normal.z));",
       "@vec3 offset_point(vec3 p, vec3 normal, Float scale) {\n"
       "    return vec3(offset_component(p.x, normal.x, scale), offset_component(p.y, normal.y, scale),\n"
       "                offset_component(p.z, normal.z, scale));"),
      ("coincident", "offset_point(point, normal) - point", "offset_point(point, normal, 1.0f) - point"),
      ("shade", "@vec3 leave_point(Scatterer scatterer, vec3 w) {\n"
       "    return offset_point(scatterer.position, select(dot(scatterer.side, w) > 0.0f, scatterer.side, -scatterer.side));",
       "@vec3 leave_point(Scatterer scatterer, vec3 w, Float scale) {\n"
       "    vec3 side = select(dot(scatterer.side, w) > 0.0f, scatterer.side, -scatterer.side);\n"
       "    return offset_point(scatterer.position, side, scale);"),
      ("shade", "leave_point(scatterer, light.direction)", "leave_point(scatterer, light.direction, 2.0f)"),
      ("shade", "leave_point(scatterer, direction)", "leave_point(scatterer, direction, 1.0f)")]),
    ("parameter from the kernel down", "parameter",
     [("path_state", "@vec3 limited(vec3 contribution, uint segments) {", "@vec3 limited(vec3 contribution, uint segments, Float scale) {"),
      ("path_state", "Float largest = max(max_component(contribution), SMALLEST);", "Float largest = max(max_component(contribution) * scale, SMALLEST);"),
      ("path_state", "@void add_radiance(Uint path, vec3 radiance, Mask where) {", "@void add_radiance(Uint path, vec3 radiance, Float scale, Mask where) {"),
      ("path_state", "limited(radiance, pass.segment)", "limited(radiance, pass.segment, scale)"),
      ("shade", "limited(contribution, pass.segment + 1u)", "limited(contribution, pass.segment + 1u, Float(1.0f))"),
      ("shade", "found_by_chance(throughput, light_pdf), shines)", "found_by_chance(throughput, light_pdf), Float(1.0f), shines)"),
      ("extend", "@void shade_sky(Uint path, vec3 direction, Throughput throughput, Mask where) {", "@void shade_sky(Uint path, vec3 direction, Throughput throughput, Float scale, Mask where) {"),
      ("extend", "add_radiance(path, throughput.weight * sky.radiance * found_by_chance(throughput, sky.pdf), where)",
       "add_radiance(path, throughput.weight * sky.radiance * found_by_chance(throughput, sky.pdf), scale, where)"),
      ("extend", "load_throughput(rows), missed)", "load_throughput(rows), Float(1.0f), missed)")]),
    ("parameter removed", "parameter",
     [("shade", "@Uint medium_before(Rows path, Surface surface, Material material) {", "@Uint medium_before(Rows path, Surface surface) {"),
      ("shade", "    Mask is_solid = (material.flags & MATERIAL_THIN_WALLED) == 0u && material.transmission > 0.0f;\n    return select(is_solid && !surface.front,",
       "    return select(!surface.front,"),
      ("shade", "medium_before(rows, surface, material)", "medium_before(rows, surface)")]),
    ("helper of two kernels", "helper",
     [("math", "@Float saturate(Float x)", "@Float cube(Float x) { return x * x * x; }\n\n@Float saturate(Float x)"),
      ("filter", "    return left * left;", "    return cube(left);"),
      ("bsdf", "both * both * both / (PI", "cube(both) / (PI")]),
    ("helper that calls a helper", "helper",
     [("lights", "@Uint entry_of(Float u, uint count)", "// Where between two entries a number lies.\n@Float between(Float low, Float high, Float x) { return saturate((x - low) / max(high - low, SMALLEST)); }\n\n"
       "@Float falloff_at(Float distance_squared) { return 1.0f / max(distance_squared, 1.0e-4f) * between(1.0e8f, 0.0f, distance_squared); }\n\n@Uint entry_of(Float u, uint count)"),
      ("lights", "select(directional, Float(1.0f), 1.0f / distance_squared)", "select(directional, Float(1.0f), falloff_at(distance_squared))")]),
    ("constant of layout.h", "layout",
     [("layout", "const uint NONE = 0xFFFFFFFFu;", "const uint NONE = 0xFFFFFFFFu;\n\nconst uint ROULETTE_SEGMENT = 3u;  // the first one that may end by chance"),
      ("shade", "pass.segment >= 3u", "pass.segment >= ROULETTE_SEGMENT")]),
    ("field of Settings", "layout",
     [("layout", "    uint pixel_count;\n", "    uint pixel_count;\n    float roulette_floor;  // the least chance of a path to go on\n"),
      ("shade", "max_component(weight), 0.05f, 1.0f", "max_component(weight), settings.roulette_floor, 1.0f")]),
    ("field in a packed row", "packed row",
     [("layout", "// absorption.rgb, unused", "// absorption.rgb, fuzz"),
      ("material", "    Uint stretched_row;\n};", "    Uint stretched_row;\n    Float fuzz;\n};"),
      ("material", "    material.energy_row = floatBitsToUint(alpha.w);\n", "    material.energy_row = floatBitsToUint(alpha.w);\n    material.fuzz = fetch_materials(rows, MATERIAL_VOLUME).w;\n"),
      ("bsdf", "    bsdf.alpha = square(material.roughness);\n", "    bsdf.alpha = square(material.roughness) + 0.25f * material.fuzz;\n")]),
    ("pack and unpack of a job", "packed row",
     [("extend", "uvec4(path, hit.instance, hit.triangle, 0u)", "uvec4(path, hit.instance, hit.triangle, pass.segment)"),
      ("shade", "    Hit hit;\n    hit.instance = row.y;\n    hit.triangle = row.z;\n", "    Hit hit;\n    hit.instance = row.y;\n    hit.triangle = row.z;\n    hit.segment = row.w;\n"),
      ("path_state", "    Uint instance;  // NONE: nothing\n    Uint triangle;\n", "    Uint instance;  // NONE: nothing\n    Uint triangle;\n    Uint segment;\n"),
      ("shade", "    if (pass.segment < settings.max_path_length) {", "    if (pass.segment < settings.max_path_length && any_lane(row.w == pass.segment)) {")]),
    ("bits packed with shift and mask", "packed row",
     [("layout", "const uint INSTANCE_HAS_TANGENTS = 1u;", "const uint INSTANCE_HAS_TANGENTS = 1u;\nconst uint INSTANCE_LAYER_SHIFT = 8u;\nconst uint INSTANCE_LAYER_MASK = 255u;"),
      ("surface", "@Mask has_tangents(vec4 mesh_row)", "@Uint layer_in(vec4 mesh_row) { return (floatBitsToUint(mesh_row.z) >> INSTANCE_LAYER_SHIFT) & INSTANCE_LAYER_MASK; }\n\n@Mask has_tangents(vec4 mesh_row)"),
      ("surface", "    return select(slot != NONE && has_tangents(mesh_row), normalized", "    return select(slot != NONE && has_tangents(mesh_row) && layer_in(mesh_row) == 0u, normalized")]),
    ("new lobe", "lobe",
     [("layout", "const uint FEATURE_DEEP_TEXELS = 524288u;", "const uint FEATURE_HAZE = 1048576u;\nconst uint FEATURE_DEEP_TEXELS = 524288u;"),
      ("core:core_tables.cpp", "        raise(material.coat > 0.0f, FEATURE_COAT);\n", "        raise(material.coat > 0.0f, FEATURE_COAT);\n        raise(material.metallic > 0.0f, FEATURE_HAZE);\n"),
      ("bsdf", "    Float under_coat;\n    Float pick_coat;\n};", "    Float under_coat;\n    Float pick_coat;\n    Float haze;\n    Float haze_alpha;\n    Float haze_root_o;\n    Float pick_haze;\n};"),
      ("bsdf", "@BsdfValue evaluate_bsdf(", HAZE_EVALUATE + "@BsdfValue evaluate_bsdf("),
      ("bsdf", "    if (has_feature(FEATURE_SHEEN)) {\n        BsdfValue sheen",
       "    if (has_feature(FEATURE_HAZE)) {\n        BsdfValue haze = evaluate_haze(bsdf, wi);\n        result.value = result.value + haze.value;\n"
       "        result.pdf = result.pdf + haze.pdf;\n    }\n    if (has_feature(FEATURE_SHEEN)) {\n        BsdfValue sheen"),
      ("bsdf", "    bsdf.pick_sheen = 0.0f;\n    if (has_feature(FEATURE_SHEEN)) {\n        bsdf = with",
       "    if (has_feature(FEATURE_HAZE)) {\n        bsdf.haze = 0.25f * material.specular;\n        bsdf.haze_alpha = max(sqrt(bsdf.alpha), 2.0e-3f);\n"
       "        bsdf.haze_root_o = smith_root(wo.z, bsdf.haze_alpha);\n        bsdf.pick_haze = 0.1f;\n        bsdf = with_picks_scaled(bsdf, 1.0f - bsdf.pick_haze);\n    }\n"
       "    bsdf.pick_sheen = 0.0f;\n    if (has_feature(FEATURE_SHEEN)) {\n        bsdf = with")]),
    ("function split in two", "split",
     [("shade", "@Scatterer make_scatterer(Surface surface, Material material, vec3 direction) {",
       "// A shading normal that cannot be seen from here would put wo below the surface.\n@vec3 seen_normal(vec3 bent, vec3 towards, vec3 side) { return select(dot(bent, towards) > 1.0e-3f, bent, side); }\n\n"
       "@Scatterer make_scatterer(Surface surface, Material material, vec3 direction) {"),
      ("shade", "    // A shading normal that cannot be seen from here would put wo below the surface.\n    vec3 normal = select(dot(bent, towards) > 1.0e-3f, bent, side);",
       "    vec3 normal = seen_normal(bent, towards, side);"),
      ("shade", "coat = select(dot(coat, towards) > 1.0e-3f, coat, side);", "coat = seen_normal(coat, towards, side);")]),
    ("block to a function of its own", "split",
     [("shade", "@void shade_path(Uint job) {",
       "// What is left of light on its way through a solid.\n@vec3 left_of_light(Uint medium, Surface surface) {\n    Uint absorbing = select(medium != 0u, medium - 1u, Uint(0u));\n"
       "    vec3 left = transmittance(absorbing, sqrt(surface.distance_squared));\n    return select(medium != 0u, left, vec3(1.0f));\n}\n\n@void shade_path(Uint job) {"),
      ("shade", "            Uint absorbing = select(medium != 0u, medium - 1u, Uint(0u));\n            vec3 left = transmittance(absorbing, sqrt(surface.distance_squared));\n"
       "            throughput.weight = throughput.weight * select(medium != 0u, left, vec3(1.0f));",
       "            throughput.weight = throughput.weight * left_of_light(medium, surface);")]),
    ("two functions merged", "merge",
     [("shade", "@Float survival_probability(vec3 weight) { return clamp(max_component(weight), 0.05f, 1.0f); }\n\n", ""),
      ("shade", "Float survival = survival_probability(carried);", "Float survival = clamp(max_component(carried), 0.05f, 1.0f);")]),
    ("two alike made one", "merge",
     [("material", "// The normal of a coat, which the surface's own normal map does not bend.\n@vec3 coat_normal(Surface surface) {\n    vec3 normal = surface.normal;\n"
       "    if (has_feature(FEATURE_LOBE_TEXTURES)) {\n        Rows rows = rows_from(surface.material * MATERIAL_ROWS);\n        vec4 slots = fetch_materials(rows, MATERIAL_LOBE_SLOTS);\n"
       "        vec4 lobes = fetch_materials(rows, MATERIAL_LOBES);\n        if (any_lane(floatBitsToUint(slots.w) != NONE)) {\n"
       "            normal = bend_normal(surface, floatBitsToUint(slots.w), lobes.w);\n        }\n    }\n    return normal;\n}\n\n", ""),
      ("shade", "vec3 coat = coat_normal(surface);", "vec3 coat = shading_normal(surface);")]),
    ("function to another file", "move",
     [("path_state", "// Balance of two strategies by the power heuristic, Veach 1997; `pdf` > 0 is the one in use.\n@Float power_heuristic(Float pdf, Float other) {\n"
       "    Float ratio = other / max(pdf, SMALLEST);\n    return 1.0f / (1.0f + ratio * ratio);\n}\n\n", ""),
      ("math", "// An orthonormal frame around", "// Balance of two strategies by the power heuristic, Veach 1997; `pdf` > 0 is the one in use.\n@Float power_heuristic(Float pdf, Float other) {\n"
       "    Float ratio = other / max(pdf, SMALLEST);\n    return 1.0f / (1.0f + ratio * ratio);\n}\n\n// An orthonormal frame around")]),
    ("field set and read in several functions", "field",
     [("surface", "    Mask front;  // the ray comes from the front side\n", "    Mask front;  // the ray comes from the front side\n    Float area;   // of the triangle\n"),
      ("surface", "    surface.geometric_normal = area * (1.0f / doubled);\n", "    surface.geometric_normal = area * (1.0f / doubled);\n    surface.area = 0.5f * doubled;\n"),
      ("guide", "add_to_guide(pixel, layer + GUIDE_NORMAL, vec4(normal, 1.0f), true);", "add_to_guide(pixel, layer + GUIDE_NORMAL, vec4(normal, max(surface.area, 1.0f)), true);"),
      ("shade", "1.0e-6f);\n        Float density = material.emission_weight * settings.light_weight_scale;", "1.0e-6f);\n        Float density = material.emission_weight * settings.light_weight_scale * max(surface.area, 1.0f);")]),
    ("field of what is sampled", "field",
     [("lights", "    Mask is_delta;   // no ray finds this light by chance\n", "    Mask is_delta;   // no ray finds this light by chance\n    Float cosine;    // at the light\n"),
      ("lights", "    light.radiance = select(shines, vec3(emission_row), vec3(0.0f));\n    light.is_delta = false;\n", "    light.radiance = select(shines, vec3(emission_row), vec3(0.0f));\n    light.is_delta = false;\n    light.cosine = abs(facing);\n"),
      ("lights", "    light.pdf = 1.0f;\n    light.is_delta = true;\n", "    light.pdf = 1.0f;\n    light.is_delta = true;\n    light.cosine = 1.0f;\n"),
      ("lights", "    light.pdf = sky_density(fetch_sky_texels(texel).w, coordinates.y);\n    light.is_delta = false;\n", "    light.pdf = sky_density(fetch_sky_texels(texel).w, coordinates.y);\n    light.is_delta = false;\n    light.cosine = 1.0f;\n"),
      ("shade", "    Mask counts = light.pdf > 0.0f && max", "    Mask counts = light.pdf > 0.0f && light.cosine > 0.0f && max")]),
    ("new struct and what makes it", "helper",
     [("bsdf", "@Float mean_fresnel(Float eta) {", "struct Interface {\n    Float outside;\n    Float inside;\n};\n\n@Interface interface_at(Float eta) {\n    Interface at;\n    at.outside = (eta - 1.0f) / (4.08567f + 1.00071f * eta);\n"
       "    at.inside = 0.997118f + eta * (0.1014f + eta * (-0.965241f - 0.130607f * eta));\n    return at;\n}\n\n@Float mean_fresnel(Float eta) {"),
      ("bsdf", "    Float from_outside = (eta - 1.0f) / (4.08567f + 1.00071f * eta);\n    Float from_inside = 0.997118f + eta * (0.1014f + eta * (-0.965241f - 0.130607f * eta));\n"
       "    return saturate(select(eta < 1.0f, from_inside, from_outside));",
       "    Interface at = interface_at(eta);\n    return saturate(select(eta < 1.0f, at.inside, at.outside));")]),
    ("overload", "helper",
     [("math", "@Float saturate(Float x)", "@vec3 square(vec3 v) { return v * v; }\n\n@Float saturate(Float x)"),
      ("bsdf", "dielectric_f0 * dielectric_f0 * (opaque * kept)", "square(dielectric_f0) * (opaque * kept)")]),
    ("new kernel file", "file",
     [("glints", None, "#guard\n\n#include <math>\n\n#open// Of so many flakes in a cone's footprint, the share that shines.\n@Float glint_share(Float footprint, Float flakes) {\n"
       "    Float seen = max(footprint * flakes, 1.0f);\n    return 1.0f / sqrt(seen);\n}\n\n#close\n"),
      ("shade", "#include <bsdf>\n", "#include <bsdf>\n#include <glints>\n"),
      ("shade", "    return select(bsdf_sample.pdf > 0.0f, 0.25f * max(bsdf.pick_diffuse, bsdf.alpha), Float(0.0f));",
       "    Float share = glint_share(bsdf.alpha, Float(4.0f));\n    return select(bsdf_sample.pdf > 0.0f, share * max(bsdf.pick_diffuse, bsdf.alpha), Float(0.0f));")]),
    ("return type, with its callers", "type",
     [("shade", "@Float survival_probability(vec3 weight) { return clamp(max_component(weight), 0.05f, 1.0f); }",
       "@vec2 survival_probability(vec3 weight) {\n    Float largest = max_component(weight);\n    return vec2(clamp(largest, 0.05f, 1.0f), largest);\n}"),
      ("shade", "        Float survival = survival_probability(carried);\n", "        vec2 survival = survival_probability(carried);\n"),
      ("shade", "PAIR_LOBE).y < survival;\n        carried = carried * (1.0f / survival);", "PAIR_LOBE).y < survival.x;\n        carried = carried * (1.0f / max(survival.x, survival.y * 0.1f));")]),
    ("stage of the filter", "stage",
     [("layout", "const uint REPROJECT_LIGHT = 7u;", "const uint FILTER_SHARPEN = 10u;    // the picture by its own Laplacian\nconst uint REPROJECT_LIGHT = 7u;"),
      ("filter", "// The picture again: each layer's light", "// What differs from the mean of its neighbours differs more.\n@void sharpen_picture(Uint job) {\n    Pixels here = pixels_in_order(job + pass.first_pixel);\n"
       "    vec4 mean = load_filter_picture(here);\n    vec3 light = vec3(load_light(pass.filter_from, here));\n"
       "    store_filter_picture(here, vec4(vec3(mean) + (vec3(mean) - light) * 0.25f, mean.w));\n}\n\n// The picture again: each layer's light"),
      ("source:filter.comp", "        filter_level(job);\n", "        filter_level(job);\n    } else if (pass.filter_stage == FILTER_SHARPEN) {\n        sharpen_picture(job);\n"),
      ("target:filter.cpp", "        for_each_job<filter_level>(pass.path_count);\n", "        for_each_job<filter_level>(pass.path_count);\n    } else if (pass.filter_stage == FILTER_SHARPEN) {\n        for_each_job<sharpen_picture>(pass.path_count);\n")]),
]
