// The handles of bdpt.h as C++ objects, and its results as exceptions.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "bdpt.h"
#include "color_options.h"
#include "error.h"

namespace bdpt_tool {

template <auto drop>
struct Dropper {
  template <class T>
  void operator()(T* handle) const {
    drop(handle);
  }
};

using Context = std::unique_ptr<bdpt_context, Dropper<bdpt_context_release>>;
using Cancel = std::unique_ptr<bdpt_cancel, Dropper<bdpt_cancel_release>>;
using Builder = std::unique_ptr<bdpt_builder, Dropper<bdpt_builder_destroy>>;
using Scene = std::unique_ptr<bdpt_scene, Dropper<bdpt_scene_release>>;
using Sensor = std::unique_ptr<bdpt_sensor, Dropper<bdpt_sensor_release>>;
using Film = std::unique_ptr<bdpt_film, Dropper<bdpt_film_release>>;
using Render = std::unique_ptr<bdpt_render, Dropper<bdpt_render_destroy>>;

// A struct of the library with its size set and all else at its default.
template <class T>
T sized() {
  T value{};
  value.struct_size = sizeof value;
  return value;
}

// Throws if the result is an error; an outcome such as BDPT_CANCELLED is passed on. `where` and `what` begin the text.
bdpt_result check(bdpt_result result, const std::string& what);
bdpt_result check(bdpt_result result, const Location& where);

// Calls a function of the library whose last parameter is the output, and returns the handle.
template <class Handle, class... Parameters, class... Arguments>
Handle make(const std::string& what, bdpt_result (*function)(Parameters...), Arguments... arguments) {
  typename Handle::pointer handle = nullptr;
  check(function(arguments..., &handle), what);
  return Handle(handle);
}

// A context that reports what the library has to say to `diagnostics`, which must outlive it.
Context make_context(std::uint32_t threads, Diagnostics& diagnostics, const ColorOptions& color = {});

bdpt_film_info film_info(const bdpt_film* film);

}  // namespace bdpt_tool
