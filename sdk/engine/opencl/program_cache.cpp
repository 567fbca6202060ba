// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/program_cache.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>

#include "opencl/cache_folder.h"
#include "opencl/content_hash.h"
#include "opencl/text.h"

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
std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
  std::string log(size, '\0');
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
  constexpr std::size_t kLongest = 2000;
  std::string text(trimmed(std::string_view(log).substr(0, log.find('\0'))));
  if (text.size() > kLongest) text = text.substr(0, text.rfind('\n', kLongest)) + "\n…";
  return text;
}

Program compile(const Device& device, const std::string& source, const std::string& options,
                std::span<const SourcePart> parts) {
  const char* text = source.data();
  const std::size_t size = source.size();
  cl_int error = CL_SUCCESS;
  Program program(clCreateProgramWithSource(device.context().get(), 1, &text, &size, &error));
  check_cl(error, "clCreateProgramWithSource");
  const cl_device_id id = device.id();
  error = clBuildProgram(program.get(), 1, &id, options.c_str(), nullptr, nullptr);
  if (error != CL_SUCCESS) {
    const std::string name(parts.empty() ? "program" : parts.back().name);
    throw Error(ErrorCode::kDevice, "kernel " + name + " does not build on " + device.info().name +
                                        " with '" + options + "' (" + error_name(error) +
                                        "): " + build_log(program.get(), id));
  }
  return program;
}

/// Empty when the driver refuses the binary.
Program program_from(const Device& device, const std::string& binary, const std::string& options) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
  const std::size_t size = binary.size();
  const cl_device_id id = device.id();
  cl_int status = CL_SUCCESS;
  cl_int error = CL_SUCCESS;
  Program program(
      clCreateProgramWithBinary(device.context().get(), 1, &id, &size, &bytes, &status, &error));
  if (error != CL_SUCCESS || status != CL_SUCCESS) return {};
  if (clBuildProgram(program.get(), 1, &id, options.c_str(), nullptr, nullptr) != CL_SUCCESS)
    return {};
  return program;
}

/// Empty when the driver gives none.
std::string binary_of(const Program& program) {
  std::size_t size = 0;
  if (clGetProgramInfo(program.get(), CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr) !=
      CL_SUCCESS)
    return {};
  std::string binary(size, '\0');
  auto* bytes = reinterpret_cast<unsigned char*>(binary.data());
  if (clGetProgramInfo(program.get(), CL_PROGRAM_BINARIES, sizeof bytes, &bytes, nullptr) !=
      CL_SUCCESS)
    return {};
  return binary;
}

}  // namespace

Program build_program(Device& device, std::span<const SourcePart> parts,
                      const std::string& options) {
  const std::string all_options = options.empty() ? "-cl-std=CL1.2" : "-cl-std=CL1.2 " + options;
  const std::string source = join(parts);
  const Hash key = program_key(device.info(), source, all_options);
  const std::string name = to_hex(key);
  if (const auto known = device.programs().find(name); known != device.programs().end()) {
    ++device.counters().reused;
    return known->second;
  }

  const auto folder = cache_folder();
  const auto path = folder ? *folder / kProgramFolder / (name + ".bin") : std::filesystem::path();
  Program program;
  if (folder) {
    if (const auto binary = load_binary(path, key))
      program = program_from(device, *binary, all_options);
  }
  if (program) {
    ++device.counters().loaded;
  } else {
    program = compile(device, source, all_options, parts);
    ++device.counters().built;
    if (folder) {
      if (const auto binary = binary_of(program); !binary.empty()) save_binary(path, key, binary);
    }
  }
  device.programs().emplace(name, program);
  return program;
}

}  // namespace gigaray::opencl
