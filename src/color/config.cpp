#include "color/config.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "color/standard_spaces.h"

namespace bdpt {
namespace {

void check_built_in(const std::string& path) {
#if OCIO_VERSION_HEX < 0x02020000
  fail(ErrorCode::Unsupported, "configuration '", path, "': OpenColorIO ", ocio::GetVersion(),
       " has none built in, they came with 2.2: give the path of a file");
#else
  (void)path;
#endif
}

void check_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) error = std::make_error_code(std::errc::is_a_directory);
  if (!error && !std::ifstream(path)) error.assign(errno, std::generic_category());
  if (error) fail(ErrorCode::Io, "cannot read configuration '", path, "': ", error.message());
}

}  // namespace

Config::Config(const std::string& path) : path_(path) {
  path.starts_with("ocio://") ? check_built_in(path) : check_file(path);
  try {
    config_ = ocio::Config::CreateFromFile(path.c_str());
  } catch (const ocio::Exception& e) {
    fail(ErrorCode::Format, "configuration '", path, "' is damaged: ", e.what());
  }
}

bool Config::has(const std::string& space) const { return config_->getColorSpace(space.c_str()) != nullptr; }

bool Config::is_data(const std::string& space) const { return config_->getColorSpace(space.c_str())->isData(); }

std::vector<std::string> Config::spaces() const {
  std::vector<std::string> names;
  const int count = config_->getNumColorSpaces();
  for (int i = 0; i < count; ++i) names.emplace_back(config_->getColorSpaceNameByIndex(i));
  return names;
}

Config::Join Config::join() const {
  if (has(ocio::ROLE_INTERCHANGE_SCENE)) return {ocio::ROLE_INTERCHANGE_SCENE, kAp0};
  for (const StandardSpace& space : standard_spaces())
    for (const char* name : space.names)
      if (space.curve == Curve::Linear && name && has(name)) return {name, space.primaries};
  fail(ErrorCode::InvalidArgument, "configuration '", path_,
       "' does not say what its colours are beside those of others: give it the role '", ocio::ROLE_INTERCHANGE_SCENE,
       "', or a space of the name 'ACES2065-1' or '", kLinearRec709, "'");
}

ocio::ConstCPUProcessorRcPtr Config::processor(const std::string& from, const std::string& to) const {
  try {
    return config_->getProcessor(from.c_str(), to.c_str())->getOptimizedCPUProcessor(kOptimization);
  } catch (const ocio::ExceptionMissingFile& e) {
    fail(ErrorCode::Io, "configuration '", path_, "': ", e.what());
  } catch (const ocio::Exception& e) {
    fail(ErrorCode::InvalidArgument, "configuration '", path_, "' cannot convert from '", from, "' to '", to,
         "': ", e.what());
  }
}

}  // namespace bdpt
