// Films on disk: a header, the sums as they are in memory, and a hash of everything before it. Little-endian.
#include "film/film.h"

#include "base/error.h"
#include "io/atomic_file.h"
#include "sampling/hash.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace bdpt {

namespace {

constexpr char kMagic[8] = {'b', 'd', 'p', 't', 'f', 'i', 'l', 'm'};
constexpr uint32_t kVersion = 5;
constexpr uint32_t kMaxRanges = 1u << 24;
constexpr uint64_t kMaxPoolPasses = 1u << 16;

static_assert(sizeof(Accumulator) == 16 && std::is_trivially_copyable_v<Accumulator>);
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "film files hold the sums as they are in memory");

class Writer {
 public:
  explicit Writer(AtomicFile& file) : file_(file) {}
  void bytes(const void* data, size_t size) {
    hash_ = hash_bytes(data, size, hash_);
    file_.write(data, size);
  }
  template <class T>
  void value(T v) {
    bytes(&v, sizeof(v));
  }
  uint64_t hash() const { return hash_; }

 private:
  AtomicFile& file_;
  uint64_t hash_ = 0;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
    if (!file_) fail(ErrorCode::Io, "path: cannot open '", path, "': ", std::strerror(errno));
  }
  ~Reader() { std::fclose(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void bytes(void* data, size_t size) {
    if (std::fread(data, 1, size, file_) != size) {
      if (std::ferror(file_)) fail(ErrorCode::Io, "path: cannot read '", path_, "': ", std::strerror(errno));
      bad("it ends too early");
    }
    hash_ = hash_bytes(data, size, hash_);
  }
  template <class T>
  T value() {
    T v;
    bytes(&v, sizeof(v));
    return v;
  }
  uint64_t hash() const { return hash_; }
  bool at_end() { return std::fgetc(file_) == EOF; }
  uint64_t remaining() {
    const long here = std::ftell(file_);
    if (here < 0 || std::fseek(file_, 0, SEEK_END) != 0) fail(ErrorCode::Io, "path: cannot seek in '", path_, "'");
    const long end = std::ftell(file_);
    if (end < here || std::fseek(file_, here, SEEK_SET) != 0) fail(ErrorCode::Io, "path: cannot seek in '", path_, "'");
    return uint64_t(end - here);
  }
  [[noreturn]] void bad(const char* why) {
    fail(ErrorCode::Format, "path: '", path_, "' is no film file, or is damaged: ", why);
  }

 private:
  std::string path_;
  std::FILE* file_;
  uint64_t hash_ = 0;
};

FilmDesc read_desc(Reader& in) {
  FilmDesc d;
  d.width = in.value<int32_t>();
  d.height = in.value<int32_t>();
  const int32_t type = in.value<int32_t>();
  d.filter.radius = in.value<float>();
  d.filter.a = in.value<float>();
  d.filter.b = in.value<float>();
  const uint32_t by_weights = in.value<uint32_t>();
  d.groups = in.value<int32_t>();
  d.pyramid_edges = in.value<int32_t>();
  d.planes = in.value<int32_t>();
  const uint32_t one_image = in.value<uint32_t>();
  d.measured = in.value<uint64_t>();
  d.unfiltered = in.value<uint64_t>();
  const uint32_t counts = in.value<uint32_t>();
  d.coverages = in.value<int32_t>();
  const bool ok = d.width >= 1 && d.width <= 65536 && d.height >= 1 && d.height <= 65536 && type >= 0 && type <= 4 &&
                  d.filter.radius >= 0.5f && d.filter.radius <= 8 && std::isfinite(d.filter.a) &&
                  std::isfinite(d.filter.b) && by_weights <= 1 && d.groups >= 1 && d.groups <= kMaxGroups &&
                  d.pyramid_edges >= 0 && d.pyramid_edges <= 15 && d.planes >= 1 && d.planes <= kMaxPlanes &&
                  one_image <= 1 && counts <= 1 && counts + one_image <= 1 &&
                  (one_image == 1 || counts == 1 || d.planes == 1) &&
                  (counts == 1 ? d.planes <= kMaxCameraPlanes : d.unfiltered == 0 && d.coverages == 0) &&
                  (d.planes >= 64 || d.unfiltered >> d.planes == 0) && d.coverages >= 0 && d.coverages <= kMaxCoverages;
  if (!ok) in.bad("its header says what cannot be");
  d.filter.type = FilterType(type);
  d.normalize_by_weights = by_weights == 1;
  d.one_image = one_image == 1;
  d.counts = counts == 1;
  return d;
}

std::vector<PassRange> read_ranges(Reader& in, uint64_t pool) {
  const uint32_t count = in.value<uint32_t>();
  if (count > kMaxRanges || uint64_t(count) * sizeof(PassRange) > in.remaining())
    in.bad("it claims too many ranges of passes");
  std::vector<PassRange> ranges;
  for (uint32_t i = 0; i < count; ++i) {
    const PassRange r{in.value<uint64_t>(), in.value<uint64_t>()};
    if (r.begin % pool != 0 || r.end % pool != 0) in.bad("its ranges of passes cut through a pool");
    if (r.begin >= r.end || (!ranges.empty() && r.begin <= ranges.back().end))
      in.bad("its ranges of passes are not in order");
    ranges.push_back(r);
  }
  return ranges;
}

// Of pixels, in order; no more than the film has.
std::map<uint64_t, uint64_t> read_counts(Reader& in, const FilmDesc& desc, uint64_t all) {
  const uint64_t pixels = uint64_t(desc.width) * uint64_t(desc.height), count = in.value<uint64_t>();
  if (count > pixels || count * 16 > in.remaining()) in.bad("it claims too many pixels with rejected contributions");
  std::map<uint64_t, uint64_t> rejected;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t pixel = in.value<uint64_t>(), n = in.value<uint64_t>();
    if (pixel >= pixels || (!rejected.empty() && pixel <= rejected.rbegin()->first) || n == 0 || n > all)
      in.bad("its rejected contributions belong to no pixels of its own");
    rejected.emplace_hint(rejected.end(), pixel, n);
    all -= n;
  }
  return rejected;
}

}  // namespace

void Film::save(const std::string& path) const {
  AtomicFile file(path);
  Writer out(file);
  out.bytes(kMagic, sizeof(kMagic));
  out.value(kVersion);
  out.value(int32_t(desc_.width));
  out.value(int32_t(desc_.height));
  out.value(int32_t(desc_.filter.type));
  out.value(desc_.filter.radius);
  out.value(desc_.filter.a);
  out.value(desc_.filter.b);
  out.value(uint32_t(desc_.normalize_by_weights));
  out.value(int32_t(desc_.groups));
  out.value(int32_t(desc_.pyramid_edges));
  out.value(int32_t(desc_.planes));
  out.value(uint32_t(desc_.one_image));
  out.value(desc_.measured);
  out.value(desc_.unfiltered);
  out.value(uint32_t(desc_.counts));
  out.value(int32_t(desc_.coverages));
  out.value(recipe_.seed);
  out.value(recipe_.scene_hash);
  out.value(recipe_.options_hash);
  out.value(recipe_.samples_per_pass);
  out.value(recipe_.pool_passes);
  out.value(rejected_);
  out.value(uint32_t(ranges_.size()));
  for (const PassRange& r : ranges_) {
    out.value(r.begin);
    out.value(r.end);
  }
  out.value(uint64_t(rejected_in_.size()));
  for (const auto& [pixel, count] : rejected_in_) {
    out.value(pixel);
    out.value(count);
  }
  out.bytes(sums_.data(), sums_.size() * sizeof(Accumulator));
  out.bytes(pyramid_.data(), pyramid_.size() * sizeof(RgbSums));
  out.bytes(coverage_.data(), coverage_.size() * sizeof(PixelCoverage));
  const uint64_t hash = out.hash();
  file.write(&hash, sizeof(hash));
  file.commit();
}

std::unique_ptr<Film> Film::load(const std::string& path, std::shared_ptr<MemoryMeter> meter) {
  Reader in(path);
  char magic[8];
  in.bytes(magic, sizeof(magic));
  if (std::memcmp(magic, kMagic, sizeof(magic)) != 0) in.bad("it does not begin like one");
  if (const uint32_t version = in.value<uint32_t>(); version != kVersion)
    fail(ErrorCode::Format, "path: '", path, "' is a film file of version ", version, "; this library reads version ",
         kVersion);
  const FilmDesc desc = read_desc(in);
  FilmRecipe recipe;
  recipe.seed = in.value<uint64_t>();
  recipe.scene_hash = in.value<uint64_t>();
  recipe.options_hash = in.value<uint64_t>();
  recipe.samples_per_pass = in.value<uint64_t>();
  recipe.pool_passes = in.value<uint64_t>();
  if (recipe.pool_passes == 0 || recipe.pool_passes > kMaxPoolPasses) in.bad("its pool has no such number of passes");
  const uint64_t rejected = in.value<uint64_t>();
  std::vector<PassRange> ranges = read_ranges(in, recipe.pool_passes);
  std::map<uint64_t, uint64_t> rejected_in = read_counts(in, desc, rejected);
  // Before memory is taken for what a damaged header claims.
  const uint64_t pixels = uint64_t(desc.width) * uint64_t(desc.height), k = uint64_t(desc.pyramid_edges);
  const uint64_t bytes =
      pixels * (sizeof(Accumulator) * PixelLayout(desc).size() * uint64_t(desc.groups) +
                sizeof(RgbSums) * (k * (k + 5) / 2) + sizeof(PixelCoverage) * uint64_t(desc.coverages));
  if (in.remaining() != bytes + sizeof(uint64_t)) in.bad("its length does not fit its header");
  auto film = std::make_unique<Film>(desc, std::move(meter));
  in.bytes(film->sums_.data(), film->sums_.size() * sizeof(Accumulator));
  in.bytes(film->pyramid_.data(), film->pyramid_.size() * sizeof(RgbSums));
  in.bytes(film->coverage_.data(), film->coverage_.size() * sizeof(PixelCoverage));
  const uint64_t expected = in.hash();
  if (in.value<uint64_t>() != expected) in.bad("its contents were changed");
  film->recipe_ = recipe;
  film->ranges_ = std::move(ranges);
  film->rejected_ = rejected;
  film->rejected_in_ = std::move(rejected_in);
  return film;
}

}  // namespace bdpt
