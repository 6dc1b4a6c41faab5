// Conversions between named colour spaces, one of which is that of the rendering.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "color/primaries.h"

namespace bdpt {

class Config;

class ColorSpaces {
 public:
  // config: the path of an OpenColorIO configuration; empty = the standard spaces alone. rendering_space: a linear
  // space; empty = linear Rec. 709. Errors: Io, Format, Unsupported (config.h); InvalidArgument (a space that is
  // unknown, not linear, not invertible, or that nothing joins to the standard spaces).
  explicit ColorSpaces(const std::string& config = {}, const std::string& rendering_space = {});
  ~ColorSpaces();

  // A name is looked for in the configuration, then among the standard spaces; empty = the rendering space. 3 floats to
  // a colour, packed, in place; a value that is not finite spoils its colour alone. What a space calls data stays as it
  // is. Conversions are kept. Any thread. Errors: Io (a table is missing), InvalidArgument (no such name, no way).
  void convert(const std::string& from, const std::string& to, float* rgb, size_t count) const;
  // Whether convert() would leave all colours as they are.
  bool is_identity(const std::string& from, const std::string& to) const;

  const std::string& rendering_space() const;  // its name
  bool renders_in_rec709() const;              // linear Rec. 709, by name or by its matrix
  const Primaries& primaries() const;          // of the rendering space
  const Config* config() const;                // or NULL

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Linear RGB of given primaries, in place, as above.
void convert_primaries(const Primaries& from, const Primaries& to, float* rgb, size_t count);

}  // namespace bdpt
