// Media: light through fog, glass that absorbs, and what overlaps it, the same by all techniques and as it must be.
#include "rendering.h"

namespace bdpt::transport_media_test {

using namespace rendering;

constexpr int kSize = 16;

std::shared_ptr<const Medium> medium(const Rgb& sigma_a, const Rgb& sigma_s, float g = 0) {
  return std::make_shared<const Medium>(Medium{"", sigma_a, sigma_s, g});
}

MaterialDesc interface(int interior) {
  MaterialDesc m;
  m.type = MaterialType::Interface;
  m.interior = interior;
  return m;
}

MaterialDesc glass(int interior, float ior = 1.5f, float alpha = 0, uint32_t priority = 0) {
  MaterialDesc m = scenes::dielectric(ior, alpha);
  m.interior = interior;
  m.priority = priority;
  return m;
}

// --- Distances and phase functions ---

const Medium kMedia[] = {{"", Rgb(0.1f), Rgb(0.5f), 0},
                         {"", Rgb(0.1f, 0.3f, 0.02f), Rgb(0.5f, 2, 0), 0.7f},
                         {"", Rgb(0), Rgb(3, 0.1f, 0.5f), -0.5f}};

// By the distance from the lobe's axis, in double: Henyey and Greenstein's function, and its integral up to there.
TEST(Medium, NarrowPhaseFunctionsKeepTheirShape) {
  for (const float g : {0.0f, 1e-4f, -0.5f, 0.99f, -0.9999f, 0.99999f, -0.99999f, 0.99999994f, -0.99999994f}) {
    const Medium m{"", Rgb(0), Rgb(1), g};
    statistics::Uniform uniform(3);
    const double a = std::abs(double(g)), rest = 1 - a;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 previous = sample_sphere(uniform(), uniform());
      const float u0 = uniform(), u1 = uniform();
      const Vec3 next = m.sample_phase(previous, u0, u1);
      const float phase = m.phase(previous, next);
      ASSERT_TRUE(std::isfinite(phase) && phase > 0) << g;
      double off_axis = 0;
      for (int c = 0; c < 3; ++c) {
        const double v = double(next[c]) + (g > 0 ? 1 : -1) * double(previous[c]);
        off_axis += v * v;
      }
      const double d = rest * rest + a * off_axis;
      const double exact = (1 - a * a) / (4 * M_PI * d * std::sqrt(d));
      ASSERT_NEAR(double(phase), exact, 1e-3 * exact) << g;
      if (rest < 1e-5) continue;  // as narrow as the rounding of directions
      const double reached = a == 0 ? off_axis / 4 : 1 - (1 - a * a) / (2 * a) * (1 / std::sqrt(d) - 1 / (1 + a));
      ASSERT_NEAR(reached, g > 0 ? double(u0) : 1 - double(u0), 0.02) << g << " " << u0;
    }
  }
}

TEST(Medium, DistancesHaveTheirDensity) {
  for (const Medium& m : kMedia) {
    statistics::Uniform uniform(7);
    constexpr int kBins = 20, kSamples = 200000;
    constexpr float kWidth = 0.2f;
    std::vector<double> counts(kBins), expected(kBins);
    for (int i = 0; i < kSamples; ++i) {
      const float u0 = uniform(), u1 = uniform();
      const float d = m.sample_distance(u0, u1);
      if (d < kWidth * kBins) ++counts[size_t(d / kWidth)];
    }
    for (int i = 0; i < kBins; ++i) {
      // The part that scatters within the bin, and the density's integral.
      const float low = kWidth * float(i), high = low + kWidth;
      const double part = double(m.reach(low)) - double(m.reach(high));
      double integral = 0;
      for (int k = 0; k < 100; ++k) {
        const float d = low + (float(k) + 0.5f) * kWidth / 100;
        integral += double(m.reach(d)) * double(m.rate(d)) * double(kWidth) / 100;
      }
      EXPECT_NEAR(integral, part, 1e-4 * part + 1e-6);
      const double n = part * kSamples;
      EXPECT_NEAR(counts[size_t(i)], n, 5 * std::sqrt(n) + 1);
    }
  }
}

TEST(Medium, PhaseFunctionsHaveTheirDensityAndMeanCosine) {
  for (const Medium& m : kMedia) {
    statistics::Uniform uniform(3);
    const Vec3 previous = unit(Vec3(0.3f, -0.5f, 0.8f));
    constexpr int kSamples = 200000;
    double mean = 0;
    std::vector<double> counts(10);
    for (int i = 0; i < kSamples; ++i) {
      const float u0 = uniform(), u1 = uniform();
      const Vec3 next = m.sample_phase(previous, u0, u1);
      EXPECT_NEAR(length(next), 1, 1e-5);
      const double c = dot(-previous, next);
      mean += c / kSamples;
      ++counts[size_t(std::clamp(int((c + 1) * 5), 0, 9))];
    }
    EXPECT_NEAR(mean, double(m.g), 4.0 / std::sqrt(double(kSamples)));
    for (int i = 0; i < 10; ++i) {
      double expected = 0;
      for (int k = 0; k < 1000; ++k) {
        const double c = -1 + 0.2 * (i + (k + 0.5) / 1000);
        const Frame frame(previous);
        const Vec3 next = frame.to_world({float(std::sqrt(1 - c * c)), 0, float(-c)});
        expected += 2 * M_PI * double(m.phase(previous, next)) * 0.2 / 1000;
      }
      EXPECT_NEAR(counts[size_t(i)], expected * kSamples, 5 * std::sqrt(expected * kSamples));
    }
  }
}

// --- What encloses a point ---

TEST(Interior, LeavesWhatWasEnteredLast) {
  Interior i;
  EXPECT_TRUE(i.is_empty());
  for (uint16_t n : {1, 2, 1, 3}) {
    EXPECT_FALSE(i.is_full());
    i = i.entered(n);
  }
  EXPECT_TRUE(i.is_full());
  EXPECT_EQ(i.left(1), Interior().entered(1).entered(2).entered(3));
  EXPECT_EQ(i.left(3), Interior().entered(1).entered(2).entered(1));
  EXPECT_EQ(i.left(2), Interior().entered(1).entered(1).entered(3));
  EXPECT_EQ(i.left(9), i);
  EXPECT_EQ(i.left(1).left(1).left(2).left(3), Interior());
}

TEST(Interior, TheHighestPriorityCounts) {
  const Medium water, smoke;
  Interiors all;
  const uint16_t low = all.add({&water, 1.33f, true, 1}), high = all.add({&smoke, 1.5f, true, 2}),
                 same = all.add({nullptr, 1.2f, true, 1});
  EXPECT_EQ(all.medium(Interior().entered(high).entered(low)), &smoke);
  EXPECT_EQ(all.medium(Interior().entered(low).entered(same)), nullptr);
  EXPECT_EQ(all.medium(Interior().entered(same).entered(low)), &water);
  EXPECT_FLOAT_EQ(all.ior(Interior().entered(high).entered(low)), 1.5f);
  EXPECT_FALSE(all.is_boundary(Interior().entered(high), low));
  EXPECT_TRUE(all.is_boundary(Interior().entered(low), high));
  EXPECT_TRUE(all.is_boundary(Interior().entered(low), same));
}

// --- Closed forms ---

scenes::MeshData wall(float z, float half) {
  return scenes::quad(Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z), Vec3(-half, half, z));
}

// The mean of the whole picture is the value, within what chance allows, and known to `precision` of it.
void expect_mean(const ScenePointer& scene, const SensorPointer& camera, const TransportOptions& options,
                 uint64_t passes, double value, double precision, double tolerance = 0) {
  const BlockMeans means = block_means(scene, camera, options, {.passes = passes, .first_seed = 5});
  const Estimate& mean = means.values.back();
  EXPECT_GT(chance(mean, value, tolerance * value), statistics::kSignificance)
      << mean.mean() << " +- " << mean.standard_error() << ", not " << value;
  EXPECT_LT(mean.standard_error(), precision * value);
  EXPECT_EQ(means.rejected, 0u);
}

// Beer's law: a lamp behind a slab of fog that only absorbs, by rays that pass its interface and by shadow rays.
TEST(Media, AbsorptionFollowsBeersLaw) {
  for (float sigma : {0.2f, 1.0f}) {
    scenes::Builder b;
    b.add(wall(-4, 0.2f), scenes::emitter(Rgb(1)));
    b.add(scenes::box(Vec3(-2, -2, -3), Vec3(2, 2, -1), false), interface(b.add_medium(medium(Rgb(sigma), Rgb(0)))));
    const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 1}, 16, 16);
    const double expected = std::exp(-2 * double(sigma));
    expect_mean(b.build(), camera, options_for(only(0, 2), 1), 16, expected, 1e-3, 1e-4);  // ways aslant are longer
    expect_mean(b.build(), camera, options_for(only(1, 1), 1), 256, expected, 5e-3, 1e-4);
  }
}

// Light that scatters once on its way along a thin ray of fog: the integral over the ray of the phase function, a point
// light's intensity, and what is left of both ways.
TEST(Media, SingleScatteringIsItsIntegral) {
  const double sigma_a = 0.1, sigma_s = 0.3, g = 0.4;
  scenes::Builder b;
  b.outside(b.add_medium(medium(Rgb(float(sigma_a)), Rgb(float(sigma_s)), float(g))));
  b.add(wall(-2, 10), scenes::diffuse(0));  // the ray's end
  const Vec3 lamp(1, 0.5f, -1);
  b.point(lamp, Rgb(1));
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 0.1f}, 16, 16);
  double expected = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * (i + 0.5) / kSteps;
    const Imath::V3d to_lamp = Imath::V3d(lamp) - Imath::V3d(0, 0, -t);
    const double d = to_lamp.length(), cosine = -to_lamp.z / d;  // between the ways before, -to_lamp, and after, +z
    const double phase = (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    expected += sigma_s * phase * std::exp(-(sigma_a + sigma_s) * (t + d)) / (d * d) * 2 / kSteps;
  }
  expect_mean(b.build(), camera, options_for(only(1, 2), 2), 64, expected, 2e-3);
  expect_mean(b.build(), camera, options_for(mask_of([](int, int) { return true; }), 2), 64, expected, 2e-3);
}

// A ball of fog that absorbs nothing, in light that comes alike from everywhere, cannot be seen: the white furnace.
TEST(Media, AFurnaceDoesNotShowFogThatOnlyScatters) {
  for (float g : {0.0f, 0.8f, -0.6f}) {
    scenes::Builder b;
    b.add_sphere(Vec3(0, 0, -3), 1, interface(b.add_medium(medium(Rgb(0), Rgb(2, 1, 0.3f), g))));
    b.environment(Rgb(1));
    const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 45}, 16, 16);
    TransportOptions options = options_for(mask_of([](int s, int) { return s == 0; }));
    options.roulette_start = 64;
    expect_mean(b.build(), camera, options, 32, 1, 5e-3);
    options.techniques = {};
    expect_mean(b.build(), camera, options, 32, 1, 5e-3);
  }
}

// Panes that overlap: the part of the one of lower priority within the other is not there, and between the two, of the
// same index, nothing is reflected. So they are one slab.
TEST(Media, OverlapsBelongToTheHigherPriority) {
  scenes::Builder b;
  const int red = b.add_medium(medium(Rgb(0, 1, 1), Rgb(0))), blue = b.add_medium(medium(Rgb(1, 1, 0), Rgb(0)));
  b.add(wall(-6, 5), scenes::emitter(Rgb(1)));
  b.add(scenes::box(Vec3(-3, -3, -2), Vec3(3, 3, -1), false), glass(red, 1.4f, 0, 2));
  b.add(scenes::box(Vec3(-3, -3, -3), Vec3(3, 3, -1.7f), false), glass(blue, 1.4f, 0, 1));
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 1}, 16, 16);
  const double r = std::pow(0.4 / 2.4, 2);
  // Through a slab that keeps t of light, with all reflections within it.
  const auto slab = [&](double t) { return (1 - r) * (1 - r) * t / (1 - r * r * t * t); };
  const double expected = (slab(std::exp(-1)) + slab(std::exp(-2)) + slab(std::exp(-1))) / 3;
  expect_mean(b.build(), camera, options_for(mask_of([](int s, int) { return s == 0; })), 64, expected, 2e-3);
}

// --- Agreement ---

struct Item {
  std::string name;
  std::function<void(scenes::Builder&)> add;
  bool fits_light_tracing = true;  // no Dirac is in the way
};

std::vector<Item> items() {
  using scenes::Builder;
  const scenes::MeshData box = scenes::box(Vec3(-0.5f, -0.9f, -0.5f), Vec3(0.4f, 0, 0.3f), false);
  return {
      {"fog everywhere", [](Builder& b) { b.outside(b.add_medium(medium(Rgb(0.1f), Rgb(0.3f, 0.4f, 0.6f), 0.5f))); }},
      {"smoke in a box",
       [=](Builder& b) { b.add(box, interface(b.add_medium(medium(Rgb(0.2f, 0.1f, 0), Rgb(1, 2, 3), -0.3f)))); }},
      {"a box of smoke in fog",
       [=](Builder& b) {
         b.outside(b.add_medium(medium(Rgb(0.05f), Rgb(0.2f), 0.5f)));
         b.add(box, interface(b.add_medium(medium(Rgb(0.2f, 0.1f, 0), Rgb(1, 2, 3), 0.3f))));
       }},
      {"a ball in smoke",
       [=](Builder& b) {
         b.add(box, interface(b.add_medium(medium(Rgb(0.2f, 0.1f, 0), Rgb(1, 2, 3), 0.3f))));
         b.add_sphere(Vec3(0, -0.5f, 0), 0.25f, scenes::diffuse(0.8f));
       }},
      {"rough glass that absorbs",
       [=](Builder& b) { b.add(box, glass(b.add_medium(medium(Rgb(0.5f, 1, 2), Rgb(0))), 1.4f, 0.4f)); }},
      {"rough glass that scatters",
       [=](Builder& b) { b.add(box, glass(b.add_medium(medium(Rgb(0.1f), Rgb(3, 2, 1), 0.2f)), 1.4f, 0.4f)); }},
      {"rough glass in a lower priority",
       [=](Builder& b) {
         b.add(box, glass(b.add_medium(medium(Rgb(0.5f, 1, 2), Rgb(0.5f))), 1.3f, 0.4f, 1));
         b.add_sphere(Vec3(0.4f, -0.5f, 0), 0.3f, glass(-1, 1.6f, 0.5f, 2));
       }},
  };
}

class TransportMedia : public testing::TestWithParam<Item> {};

TEST_P(TransportMedia, AllTechniquesGiveOnePicture) {
  scenes::Builder b = scenes::room({.points = true});
  GetParam().add(b);
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  expect_one_picture(scene, camera, technique_sets(16));
}

INSTANTIATE_TEST_SUITE_P(Items, TransportMedia, testing::ValuesIn(items()),
                         [](const auto& info) { return case_name(info.param.name); });

}  // namespace bdpt::transport_media_test
