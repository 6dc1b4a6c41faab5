#include "api/check.h"
#include "api/desc.h"
#include "api/host_array.h"
#include "api/lightmap_buffers.h"
#include "api/lightmap_instances.h"
#include "lightmap/seams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace bdpt;

namespace {

constexpr double kDefaultTolerance = 1e-5, kDefaultAngle = 15, kDefaultLambda = 0.01, kMaxLambda = 1e6;
constexpr uint32_t kDefaultIterations = 1000;

std::vector<bdpt_lightmap_image> read_images(const bdpt_lightmap_seams_desc& desc) {
  const Subject subject("desc", nullptr);
  check_channels(subject, desc.channels);
  if (desc.image_count < 1) subject.refuse("image_count", "is 0: give at least one image");
  require(desc.images, "desc.images");
  const size_t stride = read_stride(subject, "image_stride", desc.image_stride, sizeof(bdpt_lightmap_image));
  std::vector<bdpt_lightmap_image> images;
  for (uint32_t i = 0; i < desc.image_count; ++i) {
    const bdpt_lightmap_image& image = element(desc.images, i, stride);
    const std::string name = "desc.images[" + std::to_string(i) + ']';
    const Subject one(name.c_str(), nullptr);
    check_atlas_size(one, image.width, image.height);
    const uint64_t texels = uint64_t(image.width) * image.height;
    check_buffer(one, "pixels", image.pixels, alignof(float), image.capacity, texels * desc.channels * sizeof(float),
                 "capacity");
    if (image.mask) check_buffer(one, "mask", image.mask, 1, image.mask_capacity, texels);
    images.push_back(image);
  }
  return images;
}

std::vector<UvMesh> read_meshes(const bdpt_lightmap_seams_desc& desc, const std::vector<bdpt_lightmap_image>& images) {
  return read_uv_instances(desc.instances, desc.instance_count, desc.instance_stride, [&](uint32_t atlas) {
    if (atlas >= images.size())
      fail(ErrorCode::InvalidArgument, "atlas of an instance is ", atlas, ", but there are ", images.size(),
           " images: give a number below that");
    return AtlasSize{images[atlas].width, images[atlas].height};
  });
}

double diagonal(const std::vector<UvMesh>& meshes) {
  Vec3d low = meshes.front().positions.front(), high = low;
  for (const UvMesh& mesh : meshes)
    for (const Vec3d& p : mesh.positions)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
  return (high - low).length();
}

SeamOptions read_seam_options(const bdpt_lightmap_seams_desc& desc, const std::vector<UvMesh>& meshes) {
  const Subject subject("desc", nullptr);
  subject.check_not_negative("position_tolerance", &desc.position_tolerance, 1);
  subject.check_range("angle", desc.angle, 0, 180);
  SeamOptions options;
  options.position_tolerance =
      desc.position_tolerance > 0 ? double(desc.position_tolerance) : kDefaultTolerance * diagonal(meshes);
  const double angle = desc.angle > 0 ? double(desc.angle) : kDefaultAngle;
  // Rounding must not part normals that are the same.
  options.cos_angle = std::cos(angle * std::numbers::pi / 180) - 1e-9;
  return options;
}

SeamSolve read_solve(const bdpt_lightmap_seams_desc& desc) {
  Subject("desc", nullptr).check_range("lambda", desc.lambda, 0, kMaxLambda);
  SeamSolve solve;
  solve.channels = desc.channels;
  solve.lambda = desc.lambda > 0 ? double(desc.lambda) : kDefaultLambda;
  solve.max_iterations = desc.max_iterations ? desc.max_iterations : kDefaultIterations;
  return solve;
}

void write(const SeamFix& fix, const std::vector<bdpt_lightmap_image>& images, uint32_t channels) {
  for (size_t i = 0; i < fix.texels.size(); ++i)
    std::copy_n(&fix.values[i * channels], channels,
                images[fix.texels[i].image].pixels + fix.texels[i].texel * channels);
}

}  // namespace

bdpt_result bdpt_lightmap_fix_seams(const bdpt_lightmap_seams_desc* desc, bdpt_lightmap_seams_report* report) {
  return guard(__func__, [&] {
    const bdpt_lightmap_seams_desc d = read_struct(desc, "desc");
    if (report) check_output_struct(report, "report");
    const std::vector<bdpt_lightmap_image> host_images = read_images(d);
    const SeamSolve solve = read_solve(d);
    const std::vector<UvMesh> meshes = read_meshes(d, host_images);
    const std::vector<Seam> seams = find_seams(meshes, read_seam_options(d, meshes));
    std::vector<SeamImage> images;
    for (const bdpt_lightmap_image& image : host_images)
      images.push_back({image.width, image.height, image.pixels, image.mask});
    const SeamFix fix = solve_seams(seams, images, solve);
    write(fix, host_images, d.channels);
    if (!report) return;
    bdpt_lightmap_seams_report r{};
    r.iterations = fix.iterations;
    r.seams = seams.size();
    r.samples = fix.samples;
    r.samples_skipped = fix.samples_skipped;
    r.not_finite = fix.not_finite;
    r.texels = fix.texels.size();
    r.error_before = fix.error_before;
    r.error_after = fix.error_after;
    r.converged = fix.converged;
    write_struct(r, report);
  });
}
