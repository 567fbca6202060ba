// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/program_cache.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "opencl/cache_folder.h"
#include "opencl/content_hash.h"
#include "opencl/text.h"
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace gigaray::opencl {
namespace {

/// A cached program on disk: this header, then the device's binary. Files of a machine are read on
/// that machine only, so the numbers are in its byte order.
struct FileHeader {
  std::array<char, 8> magic = {'G', 'I', 'G', 'A', 'K', 'R', 'N', '2'};  ///< '2' is the version.
  std::array<std::uint64_t, 2> key{};
  std::array<std::uint64_t, 2> payload_hash{};
  std::uint64_t payload_bytes = 0;
};
static_assert(sizeof(FileHeader) == 48);

using Hash = ContentHash::Value;

Hash program_key(const DeviceInfo& info, std::string_view source, std::string_view options) {
  ContentHash hash;
  for (const std::string_view field :
       {source, options, std::string_view(info.platform), std::string_view(info.platform_version),
        std::string_view(info.vendor), std::string_view(info.name),
        std::string_view(info.driver_version)})
    hash.add(field);
  return hash.value();
}

std::string join(std::span<const SourcePart> parts) {
  std::string source;
  for (const auto& part : parts) {
    source += "#line 1 \"" + std::string(part.name) + "\"\n";
    source += part.text;
    if (!part.text.ends_with('\n')) source += '\n';
  }
  return source;
}

std::optional<std::string> load_binary(const std::filesystem::path& path, const Hash& key) {
  auto content = read_file(path);
  FileHeader header;
  if (!content || content->size() < sizeof header) return std::nullopt;
  std::memcpy(&header, content->data(), sizeof header);
  if (header.magic != FileHeader{}.magic || header.key != key) return std::nullopt;
  content->erase(0, sizeof header);
  if (header.payload_bytes != content->size() || header.payload_hash != content_hash(*content))
    return std::nullopt;
  return content;
}

/// A cache that can't be written is no error: the next start compiles again.
void save_binary(const std::filesystem::path& path, const Hash& key, const std::string& binary) {
  FileHeader header;
  header.key = key;
  header.payload_hash = content_hash(binary);
  header.payload_bytes = binary.size();
  std::string content(sizeof header, '\0');
  std::memcpy(content.data(), &header, sizeof header);
  write_file_atomically(path, content + binary);
}

/// The build log, at most its first lines: a kernel's errors repeat themselves.
std::string build_log(const cl::Program& program, const cl::Device& device) {
  const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  constexpr std::size_t kLongest = 2000;
  std::string text(trimmed(log.c_str()));
  if (text.size() > kLongest) text = text.substr(0, text.rfind('\n', kLongest)) + "\n…";
  return text;
}

cl::Program compile(const Device& device, const std::string& source, const std::string& options,
                    std::span<const SourcePart> parts) {
  cl_int error = CL_SUCCESS;
  cl::Program program(device.context(), source, false, &error);
  check_cl(error, "clCreateProgramWithSource");
  error = program.build(device.id(), options.c_str());
  if (error != CL_SUCCESS) {
    const std::string name(parts.empty() ? "program" : parts.back().name);
    throw Error(ErrorCode::kDevice, "kernel " + name + " does not build on " + device.info().name +
                                        " with '" + options + "' (" + error_name(error) +
                                        "): " + build_log(program, device.id()));
  }
  return program;
}

/// Empty when the driver refuses the binary.
cl::Program program_from(const Device& device, const std::string& binary,
                         const std::string& options) {
  std::vector<cl_int> status;
  cl_int error = CL_SUCCESS;
  cl::Program program(device.context(), {device.id()}, {{binary.begin(), binary.end()}}, &status,
                      &error);
  if (error != CL_SUCCESS || status != std::vector<cl_int>{CL_SUCCESS}) return {};
  if (program.build(device.id(), options.c_str()) != CL_SUCCESS) return {};
  return program;
}

/// Empty when the driver gives none.
std::string binary_of(const cl::Program& program) {
  cl_int error = CL_SUCCESS;
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>(&error);
  if (error != CL_SUCCESS || binaries.empty()) return {};
  return {binaries.front().begin(), binaries.front().end()};
}

}  // namespace

cl::Program build_program(const Device& device, std::span<const SourcePart> parts,
                          const std::string& options) {
  const std::string all_options = options.empty() ? "-cl-std=CL1.2" : "-cl-std=CL1.2 " + options;
  const std::string source = join(parts);
  const Hash key = program_key(device.info(), source, all_options);
  const std::string name = to_hex(key);
  Programs& programs = device.programs();
  const std::lock_guard lock(programs.mutex);
  if (const auto known = programs.by_key.find(name); known != programs.by_key.end()) {
    ++programs.counters.reused;
    return known->second;
  }

  // PoCL has a cache of its own; to hand out a binary it would compile every kernel once more.
  const auto folder = device.is_pocl() ? std::nullopt : cache_folder();
  const auto path = folder ? *folder / kProgramFolder / (name + ".bin") : std::filesystem::path();
  cl::Program program;
  if (folder) {
    if (const auto binary = load_binary(path, key))
      program = program_from(device, *binary, all_options);
  }
  if (program()) {
    ++programs.counters.loaded;
  } else {
    program = compile(device, source, all_options, parts);
    ++programs.counters.built;
    if (folder) {
      if (const auto binary = binary_of(program); !binary.empty()) save_binary(path, key, binary);
    }
#ifdef __GLIBC__
    // What the compiler took is needed for maps, not for pieces of its kind.
    malloc_trim(0);
#endif
  }
  programs.by_key.emplace(name, program);
  return program;
}

}  // namespace gigaray::opencl
