// SPDX-License-Identifier: Apache-2.0
#include "pbrt/params.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "pbrt/spectra.h"

namespace bdpt_tool {
namespace {

bool takes_strings(const std::string& type) { return type == "string" || type == "texture" || type == "bool"; }

double parse_number(const Token& token, const Location& where) {
  const char* begin = token.text.data();
  const char* end = begin + token.text.size();
  if (begin < end && *begin == '+') ++begin;
  double value = 0;
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range) return 0;
  if (result.ec != std::errc() || result.ptr != end) {
    throw Error(where, "expected a number, found '" + std::string(token.text) + "'");
  }
  return value;
}

void add_value(Param& param, const Token& token, const Location& where) {
  if (token.kind == Token::Kind::kString) {
    param.strings.push_back(token.string());
  } else if (takes_strings(param.type)) {
    if (token.text != "true" && token.text != "false") {
      throw Error(where, "'" + param.name + "' is of type " + param.type + "; put its value in quotes");
    }
    param.strings.emplace_back(token.text);
  } else {
    param.numbers.push_back(parse_number(token, where));
  }
}

}  // namespace

Param ParamList::parse_one(Lexer& lexer, const Token& declaration) const {
  Param param;
  param.where = lexer.location(declaration.line);
  const std::string text = declaration.string();
  const std::size_t type_begin = text.find_first_not_of(" \t");
  const std::size_t type_end = text.find_first_of(" \t", type_begin);
  const std::size_t name_begin = text.find_first_not_of(" \t", type_end);
  if (type_begin == std::string::npos || type_end == std::string::npos || name_begin == std::string::npos) {
    throw Error(param.where, directive_ + ": expected a parameter such as \"float radius\", found \"" + text + "\"");
  }
  param.type = text.substr(type_begin, type_end - type_begin);
  param.name = text.substr(name_begin, text.find_first_of(" \t", name_begin) - name_begin);

  std::optional<Token> token = lexer.next();
  if (!token) throw Error(param.where, "the file ends before the value of '" + param.name + "'");
  if (token->kind != Token::Kind::kOpen) {
    if (token->kind == Token::Kind::kClose) throw Error(lexer.location(token->line), "']' without '['");
    add_value(param, *token, lexer.location(token->line));
    return param;
  }
  while ((token = lexer.next()) && token->kind != Token::Kind::kClose) {
    if (token->kind == Token::Kind::kOpen) throw Error(lexer.location(token->line), "'[' inside '[ ]'");
    add_value(param, *token, lexer.location(token->line));
  }
  if (!token) throw Error(param.where, "the values of '" + param.name + "' do not end; add the closing ']'");
  return param;
}

void ParamList::parse(Lexer& lexer) {
  while (true) {
    const std::optional<Token> token = lexer.peek();
    if (!token || token->kind == Token::Kind::kWord) return;
    lexer.next();
    if (token->kind != Token::Kind::kString) {
      throw Error(lexer.location(token->line),
                  directive_ + ": expected a parameter in quotes, found '" + std::string(token->text) + "'");
    }
    Param param = parse_one(lexer, *token);
    for (const Param& other : params_) {
      if (other.name == param.name) throw Error(param.where, "'" + param.name + "' is given twice; remove one");
    }
    params_.push_back(std::move(param));
  }
}

void ParamList::fail(const Param& param, const std::string& text) const {
  throw Error(param.where, directive_ + ": '" + param.name + "' " + text);
}

const Param* ParamList::find(const std::string& name) const {
  for (const Param& param : params_) {
    if (param.name != name) continue;
    param.used = true;
    return &param;
  }
  return nullptr;
}

// count 0 = any number of values.
const Param* ParamList::find_typed(const std::string& name, std::initializer_list<const char*> types,
                                   std::size_t count) const {
  const Param* param = find(name);
  if (!param) return nullptr;
  if (std::find(types.begin(), types.end(), param->type) == types.end()) {
    fail(*param, "is of type " + param->type + ", and must be " + *types.begin());
  }
  const std::size_t have = takes_strings(param->type) ? param->strings.size() : param->numbers.size();
  if (!takes_strings(param->type) && !param->strings.empty()) fail(*param, "takes numbers, not text");
  if (count != 0 && have != count) {
    fail(*param, "has " + std::to_string(have) + " values, and must have " + std::to_string(count));
  }
  for (double number : param->numbers) {
    if (!std::isfinite(static_cast<float>(number))) fail(*param, "has a value that is not finite");
  }
  return param;
}

float ParamList::get_float(const std::string& name, float fallback) const {
  const Param* param = find_typed(name, {"float"}, 1);
  return param ? static_cast<float>(param->numbers[0]) : fallback;
}

int ParamList::get_int(const std::string& name, int fallback) const {
  const Param* param = find_typed(name, {"integer"}, 1);
  if (!param) return fallback;
  const double value = param->numbers[0];
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
    fail(*param, "must be a whole number of at most 32 bits");
  }
  return static_cast<int>(value);
}

bool ParamList::get_bool(const std::string& name, bool fallback) const {
  const Param* param = find_typed(name, {"bool"}, 1);
  if (!param) return fallback;
  if (param->strings[0] != "true" && param->strings[0] != "false") fail(*param, "must be true or false");
  return param->strings[0] == "true";
}

std::string ParamList::get_string(const std::string& name, const std::string& fallback) const {
  const Param* param = find_typed(name, {"string"}, 1);
  return param ? param->strings[0] : fallback;
}

std::string ParamList::get_texture(const std::string& name) const {
  const Param* param = find(name);
  if (!param || param->type != "texture") return "";
  return find_typed(name, {"texture"}, 1)->strings[0];
}

Rgb ParamList::get_point(const std::string& name, const Rgb& fallback) const {
  const Param* param = find_typed(name, {"point3", "point", "vector3", "vector"}, 3);
  if (!param) return fallback;
  const auto& n = param->numbers;
  return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
}

Rgb ParamList::get_rgb(const std::string& name, const Rgb& fallback, bool light) const {
  const Param* param = find(name);
  if (!param) return fallback;
  if (param->type == "blackbody") {
    if (!light) fail(*param, "is the colour of a light; give it as \"rgb " + name + "\"");
    const double kelvin = find_typed(name, {"blackbody"}, 1)->numbers[0];
    if (!(kelvin >= 500 && kelvin <= 1e6)) fail(*param, "must be from 500 to 1000000 kelvin");
    return black_body(kelvin);
  }
  if (param->type == "spectrum" && !param->strings.empty()) {
    const auto illuminant = light ? named_illuminant(param->strings[0]) : std::nullopt;
    if (!illuminant) {
      fail(*param, "names the spectrum '" + param->strings[0] + "', which is not known; give it as \"rgb " + name +
                       "\", or as pairs of wavelength and value");
    }
    return *illuminant;
  }
  if (param->type == "spectrum") {
    const auto& n = param->numbers;
    if (!are_samples(n)) fail(*param, "must be pairs of wavelength and value, by ascending wavelengths");
    return light ? emitted(n) : reflected(n);
  }
  param = find_typed(name, {"rgb"}, 3);
  const auto& n = param->numbers;
  return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
}

std::vector<float> ParamList::get_floats(const std::string& name) const {
  const Param* param = find_typed(name, {"float"}, 0);
  if (!param) return {};
  return {param->numbers.begin(), param->numbers.end()};
}

std::vector<float> ParamList::get_tuples(const std::string& name, std::size_t size) const {
  const Param* param = size == 2 ? find_typed(name, {"point2", "vector2", "float"}, 0)
                                 : find_typed(name, {"point3", "vector3", "normal", "point", "vector", "normal3"}, 0);
  if (!param) return {};
  if (param->numbers.size() % size != 0) {
    fail(*param,
         "has " + std::to_string(param->numbers.size()) + " numbers, not a multiple of " + std::to_string(size));
  }
  std::vector<float> values;
  values.reserve(param->numbers.size() + 4);  // slack the library likes behind its data
  values.assign(param->numbers.begin(), param->numbers.end());
  return values;
}

std::vector<std::uint32_t> ParamList::get_indices(const std::string& name) const {
  const Param* param = find_typed(name, {"integer"}, 0);
  if (!param) return {};
  std::vector<std::uint32_t> values;
  values.reserve(param->numbers.size() + 4);
  for (double number : param->numbers) {
    if (!(number >= 0 && number < 4294967295.0) || number != std::floor(number)) {
      fail(*param, "has a value that is no vertex index");
    }
    values.push_back(static_cast<std::uint32_t>(number));
  }
  return values;
}

void ParamList::refuse(const std::string& name, const std::string& what) const {
  if (const Param* param = find(name)) fail(*param, what);
}

void ParamList::warn_ignored(const std::string& name, const std::string& why, Diagnostics& diagnostics) const {
  if (const Param* param = find(name)) diagnostics.warn(param->where, directive_ + ": '" + name + "' " + why);
}

void ParamList::warn_unused(Diagnostics& diagnostics) const {
  for (const Param& param : params_) {
    if (!param.used)
      diagnostics.warn(param.where, directive_ + ": parameter '" + param.name + "' is not known, ignored");
  }
}

}  // namespace bdpt_tool
