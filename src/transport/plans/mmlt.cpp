// Multiplexed Metropolis light transport (Hachisuka, Kaplanyan and Dachsbacher 2014): Markov chains of paths, each of
// a length and with a technique among its coordinates; the target is the norm of the weighted contribution. Large and
// small steps, and weights of both state and proposal, after Kelemen et al. (2002).
//
// A block's work stands alone. Its candidates are samples of Veach's plan, all over the film: each contribution C of
// theirs may start a chain. With b the mean over the candidates of the sum of norm(C), and starts chosen with
// probabilities in proportion to norm(C), the start is distributed by the target in the mean, weighed by b (Veach
// 11.3.1): start-up bias is none, however short the chains are. Chains leave that distribution as it is.
//
// Paths of few edges are left to the pixels' own samples: lights that are seen directly would take most of the chains.
#include "transport/plan.h"
#include "transport/stage_timer.h"

#include <algorithm>

namespace bdpt {

namespace {

constexpr uint32_t kOrdinaryEdges = 1;    // longest path that no chain takes
constexpr uint32_t kChainPixels = 4;      // a chain has so many mutations in each pass
constexpr uint32_t kChainCandidates = 4;  // samples of Veach's plan, for each chain
constexpr uint32_t kBlock = 1024;         // pixels
constexpr uint32_t kInFlight = 256;       // samples side by side
constexpr float kLargeStep = 0.1f;        // probability

SampleCounts counts(const TransportOptions&, double) { return {}; }

void deposit(Film& film, const Contribution& c, float weight) {
  const Rgb value = c.value * weight;
  if (c.t >= 2)
    film.add_free_eye_sample(c.film, value);
  else
    film.add_light_sample(c.film, value);
  if (film.desc().pyramid_edges > 0) film.add_technique_sample(int(c.s), int(c.t), c.film, value);
}

// What may start a chain.
struct Candidate {
  double until;  // sum of norms up to here
  uint32_t sample;
  Technique technique;
};

StreamPair candidate_streams(uint64_t seed, uint32_t sample) {
  return {Stream(hash_values(seed, 1), sample), Stream(hash_values(seed, 2), sample)};
}

std::vector<Candidate> find_candidates(Block& block, uint32_t samples) {
  std::vector<Candidate> found;
  std::vector<StreamPair> streams;
  double sum = 0;
  for (uint32_t first = 0; first < samples; first += kInFlight) {
    streams.clear();
    for (uint32_t i = first; i < std::min(first + kInFlight, samples); ++i)
      streams.push_back(candidate_streams(block.seed(), i));
    for (const Contribution& c : block.sample_film(streams))
      if (const float target = norm(c.value); target > 0 && c.s + c.t - 1 > kOrdinaryEdges)
        found.push_back({sum += double(target), first + c.sample, {c.s, c.t}});
  }
  return found;
}

// Starts in proportion to the candidates' norms, evenly spread over their sum.
void begin_chains(const Block& block, const std::vector<Candidate>& candidates, std::vector<Chain>& chains) {
  const double sum = candidates.back().until, offset = double(hash_values(block.seed(), 3) >> 11) * 0x1p-53;
  size_t i = 0;
  for (uint32_t c = 0; c < chains.size(); ++c) {
    const double place = (c + offset) / double(chains.size()) * sum;
    while (i + 1 < candidates.size() && candidates[i].until <= place) ++i;
    chains[c].begin(block.engine().options.techniques, candidate_streams(block.seed(), candidates[i].sample),
                    candidates[i].technique, hash_values(block.seed(), 4, c));
  }
}

// The state of a chain, and the weight that it has gathered.
struct State {
  Contribution contribution;
  float target = 0, weight = 0;
};

void run_chains(Block& block, std::vector<Chain>& chains, uint32_t mutations, double scale) {
  const Engine& engine = block.engine();
  std::vector<State> states(chains.size());
  std::vector<const Contribution*> proposals(chains.size());
  const auto sample = [&] {
    std::fill(proposals.begin(), proposals.end(), nullptr);
    for (const Contribution& c : block.sample_chains(chains)) proposals[c.sample] = &c;
  };
  const auto leave = [&](const State& s) {
    if (s.weight > 0) deposit(engine.film, s.contribution, float(scale * double(s.weight / s.target)));
  };
  sample();
  for (size_t i = 0; i < chains.size(); ++i) {
    if (proposals[i]) states[i] = {*proposals[i], norm(proposals[i]->value), 0};
    chains[i].accept();
  }
  for (uint32_t m = 0; m < mutations; ++m) {
    for (Chain& c : chains) c.propose(engine.options.techniques, kLargeStep);
    sample();
    StageTimer timer(block.stats().accumulate);
    for (size_t i = 0; i < chains.size(); ++i) {
      State& state = states[i];
      if (state.target <= 0) continue;
      State proposal;
      if (proposals[i]) proposal = {*proposals[i], norm(proposals[i]->value), 0};
      const float acceptance = std::min(1.0f, proposal.target / state.target);
      proposal.weight = acceptance;
      state.weight += 1 - acceptance;
      if (chains[i].accepts(acceptance)) {
        ++block.stats().accepted;
        leave(state);
        state = proposal;
        chains[i].accept();
      } else {
        leave(proposal);
      }
    }
  }
  for (const State& s : states) leave(s);
  block.stats().mutations += uint64_t(chains.size()) * mutations;
}

void run(Block& block, uint64_t pass, const PixelRect& rect) {
  const Engine& engine = block.engine();
  const uint64_t passes = engine.pool_passes;
  for (uint64_t p = pass; p < pass + passes; ++p)
    for (const Contribution& c : block.sample_pixels(p, rect, kOrdinaryEdges)) deposit(engine.film, c, 1);
  if (engine.max_edges() <= kOrdinaryEdges) return;

  const uint32_t pixels = uint32_t(rect.x1 - rect.x0) * uint32_t(rect.y1 - rect.y0);
  const auto given = [](int number, uint32_t own) { return number > 0 ? uint32_t(number) : own; };
  const uint32_t share = given(engine.options.chain_pixels, kChainPixels);
  std::vector<Chain> chains((pixels + share - 1) / share);
  const uint32_t mutations = share * uint32_t(passes);
  const uint32_t samples = uint32_t(chains.size()) * given(engine.options.chain_candidates, kChainCandidates);
  const std::vector<Candidate> candidates = find_candidates(block, samples);
  if (candidates.empty()) return;
  begin_chains(block, candidates, chains);
  const double b = candidates.back().until / samples;
  run_chains(block, chains, mutations, b * pixels / double(chains.size() * share));
}

}  // namespace

extern const Plan kMmlt;
const Plan kMmlt = {.name = "mmlt",
                    .summary = "multiplexed Metropolis light transport: Markov chains of paths (Hachisuka et al.)",
                    .serves = serves_all,
                    .counts = counts,
                    .connect = connect_own,
                    .run = run,
                    .block_size = kBlock,
                    .passes = 16,
                    .chains = true,
                    .in_flight = kBlock};

}  // namespace bdpt
