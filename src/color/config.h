// An OpenColorIO configuration that a user brings. For src/color alone: OpenColorIO is seen by nobody else.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

#include "color/primaries.h"

namespace bdpt {

namespace ocio = OCIO_NAMESPACE;

// Exact, but for inverse tables, whose exact form is out of proportion.
inline constexpr auto kOptimization =
    static_cast<ocio::OptimizationFlags>(ocio::OPTIMIZATION_LOSSLESS | ocio::OPTIMIZATION_LUT_INV_FAST);

class Config {
 public:
  // Errors: Io (no such file), Format (it is none), Unsupported (built in, with an OpenColorIO that has none).
  explicit Config(const std::string& path);

  const std::string& path() const { return path_; }
  const ocio::Config& get() const { return *config_; }

  bool has(const std::string& space) const;  // by its name, an alias or a role
  bool is_data(const std::string& space) const;
  std::vector<std::string> spaces() const;

  // The space by which the standard spaces reach those of the configuration: the role aces_interchange, else a
  // standard linear space that it has by name. Errors: InvalidArgument, where there is none.
  struct Join {
    std::string space;
    Primaries primaries;
  };
  Join join() const;

  // Errors: Io (a table of it is missing), InvalidArgument (there is no way between the two).
  ocio::ConstCPUProcessorRcPtr processor(const std::string& from, const std::string& to) const;

 private:
  std::string path_;
  ocio::ConstConfigRcPtr config_;
};

}  // namespace bdpt
