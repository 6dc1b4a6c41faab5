// SPDX-License-Identifier: Apache-2.0
#include "bake_options.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "choice_option.h"
#include "handles.h"
#include "view_options.h"

namespace bdpt_tool {
namespace {

struct Kind {
  const char* name;
  bdpt_output_kind kind;
  const char* layer;
  int planes;
};
constexpr Kind kKinds[] = {{"e", BDPT_OUTPUT_IRRADIANCE, "irradiance", 1},
                           {"e-over-pi", BDPT_OUTPUT_IRRADIANCE_OVER_PI, "irradiance_over_pi", 1},
                           {"sh1", BDPT_OUTPUT_RADIANCE_SH1, "radiance_sh", 4},
                           {"sh2", BDPT_OUTPUT_RADIANCE_SH2, "radiance_sh", 9},
                           {"sh1-e", BDPT_OUTPUT_IRRADIANCE_SH1, "irradiance_sh", 4},
                           {"sh2-e", BDPT_OUTPUT_IRRADIANCE_SH2, "irradiance_sh", 9},
                           {"fluence", BDPT_OUTPUT_FLUENCE, "fluence", 1},
                           {"openness", BDPT_OUTPUT_OPENNESS, "openness", 1},
                           {"bent-normal", BDPT_OUTPUT_BENT_NORMAL, "bent_normal", 1},
                           {"openness-sh1", BDPT_OUTPUT_OPENNESS_SH1, "openness_sh", 4},
                           {"openness-sh2", BDPT_OUTPUT_OPENNESS_SH2, "openness_sh", 9},
                           {"fronts", BDPT_OUTPUT_FRONTS, "fronts", 1},
                           {"unshadowed", BDPT_OUTPUT_UNSHADOWED, "unshadowed", 1},
                           {"radiance-oct", BDPT_OUTPUT_RADIANCE_OCTAHEDRAL, "radiance_oct", 64},
                           {"irradiance-oct", BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL, "irradiance_oct", 64},
                           {"distance-oct", BDPT_OUTPUT_DISTANCE_OCTAHEDRAL, "distance_oct", 64}};

constexpr const char* kOutputsHelp =
    "What to bake, separated by commas, each in layers of its own: e: irradiance (default of lightmaps, and of "
    "points with normals); e-over-pi; fluence: over all directions, of points without normals (default); sh1, sh2 "
    "(default of probes): spherical harmonics of radiance; sh1-e, sh2-e: of irradiance; openness (one less ambient "
    "occlusion), "
    "openness-sh1, openness-sh2, bent-normal; fronts: the part of the rays that meet no back first; unshadowed: direct "
    "light as if nothing were in its way; radiance-oct, irradiance-oct, distance-oct (needs --reach): over 8 x 8 "
    "directions of an octahedral map. With -direct or -indirect behind, that part of the light alone";

bool take_ending(std::string& text, const std::string& ending) {
  if (!text.ends_with(ending)) return false;
  text.erase(text.size() - ending.size());
  return true;
}

BakeOutput parse_output(const std::string& text, bdpt_light_paths paths, double reach) {
  std::string name = text;
  if (take_ending(name, "-indirect")) {
    paths = BDPT_LIGHT_PATHS_INDIRECT;
  } else if (take_ending(name, "-direct")) {
    paths = BDPT_LIGHT_PATHS_DIRECT;
  }
  for (const Kind& kind : kKinds) {
    if (name != kind.name) continue;
    BakeOutput output{sized<bdpt_output_desc>(), {}};
    output.desc.kind = kind.kind;
    output.desc.paths = paths;
    output.desc.reach = float(reach);
    const char* part = paths == BDPT_LIGHT_PATHS_DIRECT     ? "_direct"
                       : paths == BDPT_LIGHT_PATHS_INDIRECT ? "_indirect"
                                                            : "";
    for (int plane = 0; plane < kind.planes; ++plane)
      output.layers.push_back(std::string(kind.layer) + part + (kind.planes > 1 ? "_" + std::to_string(plane) : ""));
    return output;
  }
  throw Error(ExitCode::kUsage, "--outputs: '" + text + "' is not known; " + kOutputsHelp);
}

}  // namespace

void add_bake_options(CLI::App& command, BakeOptions& options) {
  RenderOptions& render = options.render;
  command.add_option("file", render.scene, "A scene file: glTF 2.0 (.gltf, .glb), pbrt-v4, OBJ or PLY")->required();
  add_read_options(command, render.read);
  command
      .add_option(
          "-o,--output", render.output,
          "The result. Lightmaps: OpenEXR, with a layer for each plane of the outputs and one for the coverage; "
          "where several nodes of the scene are baked, each is a part of the file, by its name. Probes and "
          "points: JSON, CSV or OpenEXR, as the name ends")
      ->required();
  command
      .add_option("--what", options.what,
                  "lightmap (default): texels of surfaces; probes: a grid of points in space, light from everywhere; "
                  "points: those of a file")
      ->check(CLI::IsMember({"lightmap", "probes", "points"}));
  command.add_option("--grid", options.grid,
                     "Probes: NX,NY,NZ of them, at the centres of the cells of the box, x fastest");
  command.add_option("--box", options.box, "Where: x0,y0,z0,x1,y1,z1 (default: what the scene's surfaces fill)");
  command
      .add_option("--points", options.points,
                  "A text file: a point x y z, or x y z nx ny nz, in each line, with spaces or commas")
      ->type_name("FILE");
  command.add_flag("--files", options.files,
                   "A file for each node instead, NAME-NODE.exr, for readers that know no parts");
  command.add_option("--png", render.png,
                     "The first output through the display transform, PNG; of several nodes NAME-NODE.png each");
  add_view_options(command, render.view);
  command.add_option("--uv", options.uv_set, "Set of texture coordinates: 1 (default) or 0")->check(CLI::Range(0, 1));
  command.add_option("--resolution", options.resolution, "Side of each lightmap in texels (default 256)")
      ->check(CLI::Range(1, 65536));
  command
      .add_option("--texels-per-unit", options.texels_per_unit,
                  "Instead of --resolution: texels for a unit of length on the surface, on average")
      ->check(positive())
      ->excludes("--resolution");
  command.add_option("--outputs", options.outputs, kOutputsHelp)->type_name("LIST");
  command
      .add_option("--reach", options.reach,
                  "How far openness, bent normals and distances look (default: openness without end)")
      ->check(positive());
  command.add_flag_callback(
      "--direct-only", [&options] { options.paths = "direct"; }, "Light straight from lamps");
  command
      .add_flag_callback(
          "--indirect-only", [&options] { options.paths = "indirect"; }, "All other light")
      ->excludes("--direct-only");
  command.add_option("--subset", options.subset, "Nodes of the scene to bake (default: all that can be)")
      ->delimiter(',')
      ->type_name("NODES");
  command.add_option("--gutter", options.gutter, "Rings of texels round the charts that are filled (default 2)")
      ->check(CLI::Range(0, 64));
  command.add_flag("--geometric-normals", options.geometric_normals, "Not those that are interpolated over triangles");
  command.add_flag("--json", render.json, "Print one JSON object about the bake on stdout");
  add_film_options(command, render);
  add_limit_options(command, render);
  add_method_options(command, render);
  command.add_option("--threads", render.threads, "Threads that render (default: one per core)");
  command.footer(
      "Of several limits the first one reached counts. Ctrl-C stops and writes what is finished (exit code 130), a "
      "second Ctrl-C ends the program at once. " +
      std::string(kExitCodeHelp));
}

std::vector<BakeOutput> bake_outputs(const BakeOptions& options, const std::string& usual) {
  const bdpt_light_paths paths = options.paths == "direct"     ? BDPT_LIGHT_PATHS_DIRECT
                                 : options.paths == "indirect" ? BDPT_LIGHT_PATHS_INDIRECT
                                                               : BDPT_LIGHT_PATHS_ALL;
  std::vector<BakeOutput> outputs;
  std::istringstream list(options.outputs.empty() ? usual : options.outputs);
  for (std::string name; std::getline(list, name, ',');) outputs.push_back(parse_output(name, paths, options.reach));
  if (outputs.empty()) throw Error(ExitCode::kUsage, std::string("--outputs: the list is empty; ") + kOutputsHelp);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (outputs[i].layers[0] == outputs[j].layers[0])
        throw Error(ExitCode::kUsage, "--outputs: two of them have one name in the file; bake them apart");
  return outputs;
}

TechniqueMask bake_techniques(const BakeOptions& options) {
  const bool path = options.render.techniques.empty() && options.render.integrator == "path";
  return path ? parse_technique_mask("s<=1") : technique_mask(options.render);
}

}  // namespace bdpt_tool
