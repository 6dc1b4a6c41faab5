// Command-line options with a small set of names as values, and checks with messages in plain words.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace bdpt_tool {

// `choices` must outlive the command line.
template <class T, class Option>
void add_choice(CLI::App& command, const char* name, Option& value, const std::map<std::string, T>& choices,
                const char* help) {
  const auto assign = [&value, &choices](const std::string& text) { value = choices.at(text); };
  const auto known = [&choices](const std::string& text) {
    if (choices.contains(text)) return std::string();
    std::string names;
    for (const auto& [choice, ignored] : choices) names += (names.empty() ? "" : ", ") + choice;
    return "'" + text + "' is not known; choose one of: " + names;
  };
  command.add_option_function<std::string>(name, assign, help)->check(CLI::Validator(known, ""))->type_name("NAME");
}

inline CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value > 0 ? std::string() : "'" + text + "' must be a number greater than zero";
      },
      "");
}

}  // namespace bdpt_tool
