// The instruction set of the library's own code. code_isa_test.sh runs this with each value of BDPT_ISA.
#include "api_scene.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace bdpt_api::api_code_isa_test {

bdpt_isa asked_for() {
  const char* name = std::getenv("BDPT_ISA");
  if (!name || !*name) return BDPT_ISA_BEST;
  return std::strcmp(name, "avx512") == 0 ? BDPT_ISA_AVX512
         : std::strcmp(name, "avx2") == 0 ? BDPT_ISA_AVX2
                                          : BDPT_ISA_SSE42;
}

TEST(ApiCodeIsa, IsWhatTheEnvironmentAsksForOrTheWidest) {
  const Context context = make_context();
  bdpt_context_info info = make<bdpt_context_info>();
  ASSERT_OK(bdpt_context_get_info(context.get(), &info));
  EXPECT_NE(BDPT_ISA_BEST, info.code_isa);
  if (asked_for() != BDPT_ISA_BEST)
    EXPECT_EQ(asked_for(), info.code_isa);
  else
    EXPECT_LE(info.code_isa, info.isa);  // the ray queries' is the machine's best
}

// The sets round differently, so that a path may go another way here and there: the same picture, not the same bits.
TEST(ApiCodeIsa, EachRendersTheSamePicture) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const Contents contents(builder.get());
  const Scene scene = build(builder.get());
  const Sensor sensor = make_camera(context.get());
  const Film film = make_film(sensor.get());
  const Render render = make_render(scene.get(), sensor.get(), film.get());
  const bdpt_advance_desc advance = passes(64);
  ASSERT_OK(bdpt_render_advance(render.get(), &advance, nullptr));
  const std::vector<float> pixels = pixels_of(film.get());
  double mean = 0;
  for (float v : pixels) mean += v / double(pixels.size());
  std::printf("mean %.9g\n", mean);
  EXPECT_GT(mean, 0);
  EXPECT_TRUE(std::isfinite(mean));
}

}  // namespace bdpt_api::api_code_isa_test
