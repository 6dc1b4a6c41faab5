// The light tree: its probabilities are those it chooses with, and nothing that reaches a point is lost.
#include "light/light_tree.h"
#include "sampling/warp.h"
#include "statistics.h"

#include <gtest/gtest.h>

namespace bdpt::light_tree_test {

using statistics::Uniform;

struct Triangles {
  std::vector<Emitter> emitters;
  std::vector<std::array<Vec3, 3>> corners;
};

Vec3 random_point(Uniform& uniform, float size) {
  return (Vec3(uniform(), uniform(), uniform()) - Vec3(0.5f)) * (2 * size);
}

// Small triangles of all orientations and very different power, in clusters, and now and then a point or a spot.
Triangles cloud(int count, uint32_t seed) {
  Uniform uniform(seed);
  Triangles t;
  Vec3 cluster(0);
  for (int i = 0; i < count; ++i) {
    if (i % 16 == 0) cluster = random_point(uniform, 1);
    const Vec3 a = cluster + random_point(uniform, 0.1f);
    Emitter e;
    e.light = uint32_t(i);
    e.intensity = std::exp(6.0 * uniform() - 3);
    if (i % 7 == 0) {
      e.low = e.high = a;
      if (i % 2) e.axis = sample_sphere(uniform(), uniform()), e.cos_o = 0.9, e.cos_e = 0.95;
      t.corners.push_back({a, a, a});
    } else {
      const Vec3 b = a + random_point(uniform, 0.03f), c = a + random_point(uniform, 0.03f);
      e.low = Vec3(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z}));
      e.high = Vec3(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z}));
      e.axis = unit(cross(b - a, c - a));
      e.cos_o = 1;
      e.two_sided = i % 5 == 0;
      t.corners.push_back({a, b, c});
    }
    if (i % 11 == 3) e.intensity = 0;
    t.emitters.push_back(e);
  }
  return t;
}

Receiver random_receiver(Uniform& uniform, int i) {
  return {random_point(uniform, i % 4 == 0 ? 20.0f : 1.2f), i % 3 == 0 ? Vec3(0) : sample_sphere(uniform(), uniform())};
}

TEST(LightTree, ProbabilitiesSumToOne) {
  for (int count : {1, 2, 3, 4, 5, 17, 300, 4000}) {
    const Triangles t = cloud(count, uint32_t(count));
    const LightTree tree(t.emitters);
    Uniform uniform(1);
    for (int i = 0; i < 200; ++i) {
      const Receiver x = random_receiver(uniform, i);
      double sum = 0;
      for (uint32_t e = 0; e < t.emitters.size(); ++e) {
        const float p = tree.probability(e, x);
        EXPECT_GE(p, 0);
        EXPECT_TRUE(p == 0 || t.emitters[e].intensity > 0) << "a dark one may be chosen";
        sum += double(p);
      }
      EXPECT_NEAR(sum, 1, 2e-6) << count;
    }
  }
}

TEST(LightTree, ChoosesWithItsProbabilitiesToTheBit) {
  const Triangles t = cloud(500, 2);
  const LightTree tree(t.emitters);
  Uniform uniform(3);
  constexpr int kReceivers = 40, kSamples = 100000;
  for (int i = 0; i < kReceivers; ++i) {
    const Receiver x = random_receiver(uniform, i);
    std::vector<double> observed(t.emitters.size()), expected(t.emitters.size());
    for (uint32_t e = 0; e < expected.size(); ++e) expected[e] = double(tree.probability(e, x)) * kSamples;
    for (int k = 0; k < kSamples; ++k) {
      const LightTree::Choice c = tree.sample(x, double(uniform()) + double(uniform()) * 0x1p-24);
      EXPECT_EQ(c.probability, tree.probability(c.light, x));
      ++observed[c.light];
    }
    EXPECT_GT(statistics::chi_square_test(observed, expected), statistics::kSignificance / kReceivers) << i;
  }
}

// A choice of zero is a loss of light: it must be a proof that none arrives.
TEST(LightTree, WhatMayReachAPointMayBeChosen) {
  const Triangles t = cloud(2000, 4);
  const LightTree tree(t.emitters);
  Uniform uniform(5);
  int reaching = 0, ruled_out = 0;
  for (int i = 0; i < 300; ++i) {
    const Receiver x = random_receiver(uniform, i);
    for (uint32_t e = 0; e < t.emitters.size(); ++e) {
      if (t.emitters[e].intensity == 0) continue;
      const Vec2 b = sample_triangle(uniform(), uniform());
      const auto& c = t.corners[e];
      const Vec3 w = unit(x.p - (c[0] + (c[1] - c[0]) * b.x + (c[2] - c[0]) * b.y));
      const float cosine = dot(t.emitters[e].axis, w);
      const bool sends = t.emitters[e].cos_o == -1 || (t.emitters[e].cos_o < 1 ? cosine > 0.9f : cosine > 1e-4f) ||
                         (t.emitters[e].two_sided && cosine < -1e-4f);
      const bool reaches = sends && (x.normal == Vec3(0) || absdot(x.normal, w) > 1e-4f);
      const float p = tree.probability(e, x);
      EXPECT_TRUE(p > 0 || !reaches) << "emitter " << e << ", receiver " << i;
      reaching += reaches;
      ruled_out += p == 0;
    }
  }
  EXPECT_GT(reaching, 100000);
  EXPECT_GT(ruled_out, 10000);
}

// What the tree is for: the variance of light / probability, without shadows, against a choice by power.
TEST(LightTree, FollowsTheLightThatArrives) {
  const Triangles t = cloud(2000, 6);
  const LightTree tree(t.emitters);
  double power = 0;
  for (const Emitter& e : t.emitters) power += e.intensity;
  Uniform uniform(7);
  double by_tree = 0, by_power = 0;
  for (int i = 0; i < 100; ++i) {
    const Receiver x = random_receiver(uniform, 1);
    double sum = 0, tree_squares = 0, power_squares = 0;
    for (uint32_t e = 0; e < t.emitters.size(); ++e) {
      const Vec3 w = x.p - t.corners[e][0];
      const float d = length(w), cosine = dot(t.emitters[e].axis, w) / d;
      if (t.emitters[e].intensity == 0) continue;
      const double at_light = t.emitters[e].cos_o == -1 ? 1
                              : t.emitters[e].cos_o < 1 ? cosine > 0.9f
                              : t.emitters[e].two_sided ? std::fabs(cosine)
                                                        : std::max(0.0f, cosine);
      const double light = t.emitters[e].intensity * at_light * absdot(x.normal, w) / d / (d * d);
      sum += light;
      if (light > 0) tree_squares += light * light / double(tree.probability(e, x));
      power_squares += light * light / (t.emitters[e].intensity / power);
    }
    by_tree += tree_squares / (sum * sum) - 1;
    by_power += power_squares / (sum * sum) - 1;
  }
  EXPECT_LT(by_tree * 4, by_power) << by_tree << " and " << by_power;
}

TEST(LightTree, TakesWhateverItIsGiven) {
  EXPECT_TRUE(LightTree(std::vector<Emitter>()).empty());
  EXPECT_TRUE(LightTree(std::vector<Emitter>(5)).empty());  // all dark
  std::vector<Emitter> same(1000);                          // all at one place
  for (size_t i = 0; i < same.size(); ++i) same[i].light = uint32_t(i), same[i].intensity = 1;
  std::vector<Emitter> line(3000);  // powers and distances that no split by cost divides evenly
  for (size_t i = 0; i < line.size(); ++i) {
    line[i].light = uint32_t(i);
    line[i].low = line[i].high = Vec3(std::exp2(float(i) / 60 - 30), 0, 0);
    line[i].intensity = std::exp2(double(i) / 10 - 150);
  }
  for (const std::vector<Emitter>* given : {&same, &line}) {
    const std::vector<Emitter>& emitters = *given;
    const LightTree tree(emitters);
    Uniform uniform(8);
    for (int i = 0; i < 20; ++i) {
      const Receiver x = i == 0 ? Receiver{emitters[0].low, Vec3(0, 1, 0)} : random_receiver(uniform, i);
      double sum = 0;
      for (uint32_t e = 0; e < emitters.size(); ++e) sum += double(tree.probability(e, x));
      EXPECT_NEAR(sum, 1, 1e-5);
      for (double u : {0.0, 0.5, 1 - 0x1p-53}) {
        const LightTree::Choice c = tree.sample(x, u);
        EXPECT_EQ(c.probability, tree.probability(c.light, x));
        EXPECT_GT(c.probability, 0);
      }
    }
  }
}

}  // namespace bdpt::light_tree_test
