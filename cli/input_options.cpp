// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "input_options.h"

#include <map>
#include <string>

namespace gigaray::cli {

void InputOptions::add_to(CLI::App& app) {
  static const std::map<std::string, Travel> kDirections{
      {"auto", Travel::kAuto}, {"left", Travel::kLeft}, {"right", Travel::kRight}};
  app.add_option("INPUT", input, "Folder or file of the light field")->required();
  app.add_option("--positions", open.positions,
                 "Text file: where each picture was taken, 'right', 'right down' or "
                 "'name right down' per line")
      ->type_name("FILE");
  app.add_option("--direction", open.direction,
                 "Way of the camera as the numbers of the pictures rise: left, right or auto "
                 "(default: right is assumed and checked)")
      ->transform(CLI::Transformer(kDirections).description(""))
      ->check(CLI::IsMember({Travel::kAuto, Travel::kLeft, Travel::kRight}).description(""))
      ->type_name("WAY");
}

}  // namespace gigaray::cli
