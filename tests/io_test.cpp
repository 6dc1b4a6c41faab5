// Files: whole or not at all, and what is in them is what was given.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <half.h>
#include <png.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <thread>
#include <vector>

#include "base/error.h"
#include "io/atomic_file.h"
#include "io/exr.h"
#include "io/png.h"
#include "temp_folder.h"

namespace bdpt::io_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::string read_all(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The error that f throws; its text must hold every one of parts.
void expect_error(ErrorCode code, const std::vector<std::string>& parts, const std::function<void()>& f) {
  try {
    f();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(code), static_cast<int>(error.code())) << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

std::vector<float> ramp(uint32_t width, uint32_t height) {
  std::vector<float> pixels(size_t{3} * width * height);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i) / static_cast<float>(pixels.size());
  return pixels;
}

// Runs f in a process of its own and gives its exit status: 0 where f is true.
int run_in_child(const std::function<bool()>& f) {
  const pid_t child = fork();
  if (child == 0) _exit(f() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

bool fails_with_io(int reason, const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.code() == ErrorCode::Io && std::strstr(error.what(), std::strerror(reason));
  }
  return false;
}

// f, where no file may grow beyond bytes, as on a full disk: true if it fails for this reason.
bool fails_when_full(rlim_t bytes, const std::function<void()>& f) {
  return run_in_child([&] {
           signal(SIGXFSZ, SIG_IGN);
           const rlimit limit{bytes, bytes};
           return setrlimit(RLIMIT_FSIZE, &limit) == 0 && fails_with_io(EFBIG, f);
         }) == 0;
}

TEST(AtomicFile, AppearsOnlyAtCommit) {
  const TempFolder folder;
  const std::string path = folder.file("a");
  AtomicFile file(path);
  file.write("new", 3);
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(read_all(path), "new");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, WithoutCommitLeavesTheOldFileAndNothingElse) {
  const TempFolder folder;
  const std::string path = folder.file("a");
  write_text(path, "old");
  {
    AtomicFile file(path);
    file.write("half", 4);
  }
  EXPECT_EQ(read_all(path), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, CanGoBackAndOverwrite) {
  const TempFolder folder;
  AtomicFile file(folder.file("a"));
  file.write("abcdef", 6);
  EXPECT_EQ(file.position(), 6u);
  file.seek(2);
  file.write("XY", 2);
  file.commit();
  EXPECT_EQ(read_all(folder.file("a")), "abXYef");
}

TEST(AtomicFile, HasTheModeOfAnyNewFile) {
  const TempFolder folder;
  write_text(folder.file("a"), "text");
  struct stat status;
  ASSERT_EQ(stat(folder.file("a").c_str(), &status), 0);
  const mode_t mask = umask(0);
  umask(mask);
  EXPECT_EQ(status.st_mode & 0777u, 0666u & ~mask);
}

TEST(AtomicFile, TakesTheLongestNameAllowed) {
  const TempFolder folder;
  write_text(folder.file(std::string(255, 'n')), "text");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, FollowsASymbolicLink) {
  const TempFolder folder;
  write_text(folder.file("target"), "old");
  std::filesystem::create_symlink(folder.file("target"), folder.file("link"));
  write_text(folder.file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(read_all(folder.file("target")), "new");
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
  const TempFolder folder;
  expect_error(ErrorCode::Io, {"empty"}, [] { AtomicFile(""); });
  expect_error(ErrorCode::Io, {folder.path().string(), std::strerror(EISDIR)},
               [&] { AtomicFile(folder.path().string()); });
  expect_error(ErrorCode::Io, {std::strerror(EISDIR)}, [&] { AtomicFile(folder.file("new/")); });
  expect_error(ErrorCode::Io, {"/dev/null", "regular"}, [] { AtomicFile("/dev/null"); });
  expect_error(ErrorCode::Io, {"/no-such-folder/a", std::strerror(ENOENT)}, [] { AtomicFile("/no-such-folder/a"); });
  EXPECT_EQ(folder.count(), 0u);
}

TEST(AtomicFile, FailsInAReadOnlyFolderAndOnAReadOnlyFile) {
  const TempFolder folder;
  write_text(folder.file("a"), "old");
  chmod(folder.file("a").c_str(), 0444);
  chmod(folder.path().c_str(), 0555);
  const int status = run_in_child([&] {
    if (geteuid() == 0 && setuid(65534) != 0) return false;  // root could write
    return fails_with_io(EACCES, [&] { AtomicFile(folder.file("a")); }) &&
           fails_with_io(EACCES, [&] { AtomicFile(folder.file("b")); });
  });
  chmod(folder.path().c_str(), 0755);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_all(folder.file("a")), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, FailsOnAFullDisk) {
  const TempFolder folder;
  const std::string path = folder.file("a");
  write_text(path, "old");
  const auto write_much = [&] { write_text(path, std::string(1 << 20, 'x')); };
  EXPECT_TRUE(fails_when_full(1000, write_much));
  EXPECT_EQ(read_all(path), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, RemembersAFailureThatWasSwallowed) {
  const TempFolder folder;
  const auto swallow = [&] {
    AtomicFile file(folder.file("a"));
    const std::string text(1 << 20, 'x');
    try {
      file.write(text.data(), text.size());
    } catch (const Error&) {
    }
    file.commit();
  };
  EXPECT_TRUE(fails_when_full(1000, swallow));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(AtomicFile, MayBeWrittenByManyThreadsAtOnce) {
  const TempFolder folder;
  const std::string path = folder.file("a");
  std::vector<std::thread> threads;
  threads.reserve(8);
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] {
      for (int j = 0; j < 50; ++j) write_text(path, std::string(10000, static_cast<char>('a' + i)));
    });
  for (std::thread& thread : threads) thread.join();
  const std::string text = read_all(path);
  EXPECT_EQ(text, std::string(10000, text.at(0)));
  EXPECT_EQ(folder.count(), 1u);
}

std::vector<float> read_exr(const std::string& path, const std::string& prefix, Imf::PixelType* stored = nullptr) {
  Imf::InputFile file(path.c_str(), 0);
  const Imath::Box2i window = file.header().dataWindow();
  const size_t width = static_cast<size_t>(window.max.x - window.min.x) + 1;
  const size_t height = static_cast<size_t>(window.max.y - window.min.y) + 1;
  std::vector<float> pixels(3 * width * height);
  Imf::FrameBuffer buffer;
  const char* names[3] = {"R", "G", "B"};
  for (size_t c = 0; c < 3; ++c) {
    const Imf::Channel* channel = file.header().channels().findChannel(prefix + names[c]);
    if (!channel) throw std::runtime_error("no channel " + prefix + names[c]);
    if (stored) *stored = channel->type;
    buffer.insert(prefix + names[c],
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data() + c), 12, 12 * width));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return pixels;
}

TEST(Exr, KeepsEveryFloatOfEveryLayer) {
  const TempFolder folder;
  const std::string path = folder.file("a.exr");
  const uint32_t width = 37, height = 53;  // no multiple of a ZIP block
  std::vector<float> main = ramp(width, height), other = ramp(width, height);
  main[0] = 1e30f, main[1] = -2.5f, main[2] = kInf, main[3] = kNan;
  for (float& value : other) value = 1 - value;
  write_exr(path, width, height, {{"", main.data()}, {"s1t2", other.data()}}, false);

  Imf::PixelType type;
  const std::vector<float> read = read_exr(path, "", &type);
  EXPECT_EQ(type, Imf::FLOAT);
  EXPECT_EQ(std::memcmp(read.data(), main.data(), main.size() * sizeof(float)), 0);
  EXPECT_EQ(read_exr(path, "s1t2."), other);
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Exr, AsHalfRoundsAndClipsWhatIsFinite) {
  const TempFolder folder;
  const std::string path = folder.file("a.exr");
  const uint32_t width = 20, height = 40;
  std::vector<float> pixels = ramp(width, height);
  pixels[0] = 1e30f, pixels[1] = -1e30f, pixels[2] = kInf, pixels[3] = kNan;
  write_exr(path, width, height, {{"", pixels.data()}}, true);

  Imf::PixelType type;
  const std::vector<float> read = read_exr(path, "", &type);
  EXPECT_EQ(type, Imf::HALF);
  EXPECT_EQ(read[0], 65504.0f);
  EXPECT_EQ(read[1], -65504.0f);
  EXPECT_EQ(read[2], kInf);
  EXPECT_TRUE(std::isnan(read[3]));
  for (size_t i = 4; i < pixels.size(); ++i) EXPECT_EQ(read[i], static_cast<float>(half(pixels[i])));
}

TEST(Exr, NamesTheChromaticitiesOfItsPixels) {
  const TempFolder folder;
  const std::string path = folder.file("a.exr");
  const std::vector<float> pixels = ramp(4, 4);
  const auto written = [&] {
    const Imf::InputFile file(path.c_str());
    EXPECT_TRUE(Imf::hasChromaticities(file.header()));
    const Imf::Chromaticities c = Imf::chromaticities(file.header());
    return ExrChromaticities{
        {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}}};
  };
  write_exr(path, 4, 4, {{"", pixels.data()}}, false);
  EXPECT_EQ(kRec709Chromaticities, written());
  const ExrChromaticities acescg{{{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}}};
  write_exr(path, 4, 4, {{"", pixels.data()}}, true, acescg);
  EXPECT_EQ(acescg, written());
}

TEST(Exr, RefusesWhatCannotBeWritten) {
  const TempFolder folder;
  const std::string path = folder.file("a.exr");
  const std::vector<float> pixels = ramp(4, 4);
  const auto code = ErrorCode::InvalidArgument;
  expect_error(code, {"0 x 4"}, [&] { write_exr(path, 0, 4, {{"", pixels.data()}}, false); });
  expect_error(code, {"layer"}, [&] { write_exr(path, 4, 4, {}, false); });
  expect_error(code, {"'a'"}, [&] { write_exr(path, 4, 4, {{"a", nullptr}}, false); });
  expect_error(code, {"'a'"}, [&] { write_exr(path, 4, 4, {{"a", pixels.data()}, {"a", pixels.data()}}, false); });
  expect_error(code, {"longer"}, [&] { write_exr(path, 4, 4, {{std::string(254, 'a'), pixels.data()}}, false); });
  EXPECT_EQ(folder.count(), 0u);
  write_exr(path, 4, 4, {{std::string(253, 'a'), pixels.data()}}, false);
  EXPECT_EQ(read_exr(path, std::string(253, 'a') + "."), pixels);
}

// The limit is tried at every size, so that each part of the file, its table of scanlines too, is cut once.
TEST(Exr, FailsOnAFullDiskWhereverItIsFull) {
  const TempFolder folder;
  const std::string path = folder.file("a.exr");
  const std::vector<float> pixels = ramp(16, 100);
  const auto write = [&] { write_exr(path, 16, 100, {{"", pixels.data()}}, false); };
  write();
  const rlim_t size = std::filesystem::file_size(path);
  const std::string whole = read_all(path);
  for (rlim_t limit = 0; limit < size; limit += size / 40 + 1) EXPECT_TRUE(fails_when_full(limit, write)) << limit;
  EXPECT_TRUE(fails_when_full(size - 1, write));
  EXPECT_EQ(read_all(path), whole);
  EXPECT_EQ(folder.count(), 1u);
}

std::vector<uint8_t> read_png(const std::string& path, uint32_t* width, uint32_t* height) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, path.c_str())) throw std::runtime_error(image.message);
  image.format = PNG_FORMAT_RGB;
  std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr)) throw std::runtime_error(image.message);
  *width = image.width, *height = image.height;
  return bytes;
}

TEST(Png, ClipsAndRounds) {
  const TempFolder folder;
  const std::string path = folder.file("a.png");
  const std::vector<float> pixels = {0,    1,     0.5f,  -1,   2, 0.49f / 255, 0.51f / 255, 254.49f / 255,
                                     kInf, -kInf, 1e30f, -0.0f};
  write_png(path, pixels.data(), 2, 2);
  uint32_t width, height;
  const std::vector<uint8_t> expected = {0, 255, 128, 0, 255, 0, 1, 254, 255, 0, 255, 0};
  EXPECT_EQ(read_png(path, &width, &height), expected);
  EXPECT_EQ(width, 2u);
  EXPECT_EQ(height, 2u);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Png, RefusesWhatCannotBeWritten) {
  const TempFolder folder;
  const std::string path = folder.file("a.png");
  std::vector<float> pixels = ramp(4, 4);
  expect_error(ErrorCode::InvalidArgument, {"4 x 0"}, [&] { write_png(path, pixels.data(), 4, 0); });
  expect_error(ErrorCode::InvalidArgument, {"no pixels"}, [&] { write_png(path, nullptr, 4, 4); });
  pixels[3 * (2 * 4 + 1)] = kNan;
  expect_error(ErrorCode::InvalidArgument, {"(1, 2)"}, [&] { write_png(path, pixels.data(), 4, 4); });
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Png, FailsOnAFullDiskWhereverItIsFull) {
  const TempFolder folder;
  const std::string path = folder.file("a.png");
  std::vector<float> pixels(3 * 64 * 64);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i * 2654435761u % 1000) / 1000;
  const auto write = [&] { write_png(path, pixels.data(), 64, 64); };
  write();
  const rlim_t size = std::filesystem::file_size(path);
  const std::string whole = read_all(path);
  for (rlim_t limit = 0; limit < size; limit += size / 20 + 1) EXPECT_TRUE(fails_when_full(limit, write)) << limit;
  EXPECT_TRUE(fails_when_full(size - 1, write));
  EXPECT_EQ(read_all(path), whole);
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace bdpt::io_test
