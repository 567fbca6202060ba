// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Files that are none, and files that lie about their size: refused in one line, before anything is
// waited for or allocated.
#include <hdf5.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "adapters/adapters_test.h"
#include "adapters/light_field_files.h"
#include "formats/described_light_field.h"
#include "formats/positions_file.h"
#include "formats/section_file.h"
#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/hci_old.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/sparse/sparse_coding.h"
#include "pictures/map_headers.h"

namespace gigaray {
namespace {

constexpr double kMiB = 1 << 20;
/// The least that a limit can be, and a picture beyond it.
constexpr double kLimit = 64 * kMiB;
constexpr int kTooWide = 4000, kTooHigh = 3000;

class HostileInput : public AdaptersTest {
 protected:
  std::filesystem::path pipe(const std::string& name) const {
    const std::filesystem::path path = folder / name;
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  std::filesystem::path endless(const std::string& name) const {
    std::filesystem::create_symlink("/dev/zero", folder / name);
    return folder / name;
  }
  /// A file whose blocks were never written.
  std::filesystem::path hollow(const std::string& name, const std::string& head,
                               std::uintmax_t size) const {
    write(name, head);
    std::filesystem::resize_file(folder / name, size);
    return folder / name;
  }
  void save_black(const std::string& name, int width, int height) const {
    ASSERT_TRUE(cv::imwrite((folder / name).string(), cv::Mat(height, width, CV_8U, cv::Scalar(0)),
                            {cv::IMWRITE_PNG_BILEVEL, 1}));
  }
  static OpenOptions within(double bytes) {
    OpenOptions options;
    options.memory_bytes = bytes;
    return options;
  }
  template <class Call>
  void expect_bad(const std::vector<std::string>& parts, Call call) const {
    testing_support::expect_error(ErrorCode::kBadInput, parts, call);
  }
  void expect_no_file(const std::filesystem::path& path) const {
    const std::string name = path.filename().string();
    expect_bad({name, "not a file"}, [&] { read_text(path); });
    expect_bad({name, "not a file"}, [&] { read_picture(path); });
    for (const auto read : {read_pfm, read_npy, read_exr, read_colmap_depth_map})
      expect_bad({name, "not a file"}, [&] { read(path); });
    expect_bad({name, "not a file"}, [&] { open_light_field(path); });
    expect_bad({name, "not a file"}, [&] { SparseFile{path}; });
    expect_bad({name, "not a file"}, [&] { read_camera(path); });
    expect_bad({name, "not a file"}, [&] { read_hci_old_truth(path); });
    expect_bad({name, "not a file"}, [&] { read_positions(path, {}); });
  }
};

TEST_F(HostileInput, PipesAreRefusedWithoutWaiting) { expect_no_file(pipe("pipe")); }

TEST_F(HostileInput, DevicesAreRefused) { expect_no_file(endless("zero")); }

TEST_F(HostileInput, SocketsAreRefused) {
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = (folder / "socket").string();
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  expect_no_file(path);
  close(listener);
}

TEST_F(HostileInput, PipesAmongPicturesAreNoPictures) {
  save("view_1.png");
  save("view_2.png");
  pipe("view_3.png");
  endless("view_4.png");
  EXPECT_EQ(open_light_field(folder).num_views(), 2);
}

TEST_F(HostileInput, PipesThatDescriptionsNameAreRefused) {
  pipe("a.png");
  save("b.png");
  write("gigaray.json",
        R"({"format": "gigaray light field", "version": 1, "kind": "3D", "width": 23, "height": 17,
            "views": [{"name": "a", "s": -0.5, "t": 0, "file": "a.png"},
                      {"name": "b", "s": 0.5, "t": 0, "file": "b.png"}]})");
  expect_bad({"a.png", "pipe"}, [&] { open_light_field(folder); });
  save("input_Cam000.png");
  save("input_Cam001.png");
  std::filesystem::remove(folder / "gigaray.json");
  endless("parameters.cfg");
  expect_bad({"parameters.cfg", "device"}, [&] { open_light_field(folder); });
}

TEST_F(HostileInput, PicturesAreHeldAgainstTheLimitByTheirHeaders) {
  save_black("view_1.png", kTooWide, kTooHigh);
  save_black("view_2.png", kTooWide, kTooHigh);
  ASSERT_LT(std::filesystem::file_size(folder / "view_1.png"), 10000u);
  expect_bad({"view_1.png", "4000×3000", "69 MiB", "64 MiB"},
             [&] { open_light_field(folder, within(1)); });
  expect_bad({"view_1.png", "4000×3000"},
             [&] { read_picture(folder / "view_1.png", nullptr, kLimit); });
  EXPECT_EQ(read_picture(folder / "view_1.png", nullptr, 2 * kLimit).width(), kTooWide);
}

TEST_F(HostileInput, ManyPicturesThatFitOneAtATimeOpen) {
  save_black("first.png", 3600, 2900);
  for (int i = 0; i < 100; ++i)
    std::filesystem::create_symlink("first.png", folder / ("view_" + std::to_string(i) + ".png"));
  std::filesystem::rename(folder / "first.png", folder / "view_100.png");
  std::filesystem::create_symlink("view_100.png", folder / "first.png");
  const LightField light_field = open_light_field(folder, within(kLimit));
  EXPECT_EQ(light_field.num_views(), 101);
  EXPECT_EQ(read_view(light_field, 50).height(), 2900);
}

TEST_F(HostileInput, PicturesOfAHeaderAloneAreDamaged) {
  write("a.ppm", "P6 9000 9000 255\n12345");
  expect_bad({"a.ppm", "9000×9000", "22 bytes"},
             [&] { read_picture(folder / "a.ppm", nullptr, 1e12); });
  save_black("a.png", 31, 29);
  std::string bytes = read("a.png");
  // Width and height; without the right checksum libpng says the same.
  bytes[17] = bytes[21] = '\x01';
  write("a.png", bytes);
  expect_bad({"a.png", "damaged"}, [&] { read_picture(folder / "a.png", nullptr, 1e12); });
}

TEST_F(HostileInput, DrawingsUnderTheNameOfAPictureAreRefused) {
  write("a.png", R"(<svg xmlns="http://www.w3.org/2000/svg" width="30" height="20"/>)");
  expect_bad({"a.png", "no picture"}, [&] { read_picture(folder / "a.png"); });
}

TEST_F(HostileInput, JpegsOfAThousandScansAreRefused) {
  cv::imwrite((folder / "a.jpg").string(), picture(), {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  EXPECT_EQ(read_picture(folder / "a.jpg").width(), kWidth);
  std::string bytes = read("a.jpg");
  const std::size_t scan = bytes.find("\xff\xda");
  const std::size_t next = bytes.find("\xff\xda", scan + 2);
  ASSERT_NE(next, std::string::npos);
  std::string more;
  for (int i = 0; i < 1000; ++i) more += bytes.substr(scan, next - scan);
  write("a.jpg", bytes.substr(0, scan) + more + bytes.substr(scan));
  expect_bad({"a.jpg", "scans"}, [&] { read_picture(folder / "a.jpg"); });
}

TEST_F(HostileInput, LensletPicturesAreHeldAgainstTheLimitWithTheirViews) {
  save_black("a_eslf.png", 2800, 2100);
  expect_bad({"a_eslf.png", "2800×2100", "67 MiB"},
             [&] { open_light_field(folder / "a_eslf.png", within(kLimit)); });
}

TEST_F(HostileInput, TheCanvasOfAllPicturesIsHeldAgainstTheLimit) {
  save_black("wide.png", 20000, 1);
  save_black("high.png", 1, 20000);
  write("transforms.json", R"({"frames": [
      {"file_path": "wide.png", "w": 20000, "h": 1, "fl_x": 20000,
       "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]},
      {"file_path": "high.png", "w": 1, "h": 20000, "fl_x": 20000,
       "transform_matrix": [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]}]})");
  expect_bad({".png", "20000×20000"}, [&] { open_light_field(folder, within(kLimit)); });
}

TEST_F(HostileInput, DeepAndLargeJsonIsRefusedBeforeItIsParsed) {
  check_json(std::string(kDeepestJson, '[') + std::string(kDeepestJson, ']'), "a.json");
  check_json(R"({"text": "[[[[[ \" [[[[", "more": [[[1]]]})" + std::string(1000, ' '), "a.json");
  expect_bad({"a.json", "nested"},
             [] { check_json(std::string(kDeepestJson + 1, '['), "a.json"); });
  std::string list = "[1";
  for (int i = 0; i < 2'000'000; ++i) list += ",1";
  expect_bad({"a.json", "values", "limit"}, [&] { check_json(list + "]", "a.json", kLimit); });
  for (const char* name : {"transforms.json", "gigaray.json"}) {
    write(name, std::string(100'000, '['));
    expect_bad({name, "nested"}, [&] { open_light_field(folder / name); });
    expect_bad({name, "nested"}, [&] { read_camera(folder / name); });
  }
  expect_bad({"gigaray.json", "nested"}, [&] { DepthResult{folder}; });
}

TEST_F(HostileInput, FilesOfTextHaveALargestSize) {
  const auto text = hollow("a.txt", "", kMostText + 1);
  expect_bad({"a.txt", "limit", "16 MiB"}, [&] { read_text(text); });
  const auto json = hollow("a.json", "", kMostJson + 1);
  expect_bad({"a.json", "limit", "128 MiB"}, [&] { read_json_text(json); });
}

TEST_F(HostileInput, EndlessLinesOfPositionsAreOneShortMessage) {
  std::string words;
  for (int i = 0; i < 1'000'000; ++i) words += "1 ";
  const std::vector<std::filesystem::path> pictures{"a.png", "b.png"};
  expect_bad({"p.txt:1", "more than"}, [&] { parse_positions(words, "p.txt", pictures); });
  expect_bad({"1000000 positions for 2 pictures"}, [&] {
    std::replace(words.begin(), words.end(), ' ', '\n');
    parse_positions(words, "p.txt", pictures);
  });
  try {
    parse_positions(std::string(1'000'000, 'x') + " 1", "p.txt", pictures);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_LT(std::string_view(error.what()).size(), 200u);
  }
}

TEST_F(HostileInput, MapsAreHeldAgainstTheirFilesAndTheLimit) {
  const std::uintmax_t huge = std::uintmax_t(1) << 42;
  expect_bad({"a.pfm", "cut short"},
             [&] { read_pfm(hollow("a.pfm", "Pf 99999 99999 -1\n", 999)); });
  // It is as long as it says, and none of it was ever written.
  expect_bad({"b.pfm", "limit"},
             [&] { read_pfm(hollow("b.pfm", "Pf 1048576 1048576 -1\n", 22 + huge)); });
  expect_bad({"b.bin", "limit"},
             [&] { read_colmap_depth_map(hollow("b.bin", "1048576&1048576&1&", 18 + huge)); });
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1048576, 1048576), }";
  header.resize(118, ' ');
  expect_bad({"b.npy", "limit"}, [&] {
    read_npy(hollow("b.npy", std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header, 128 + huge));
  });
  expect_bad({"c.npy", "no NumPy"}, [&] { read_npy(hollow("c.npy", "", huge)); });
  expect_bad({"b.exr", "no OpenEXR"}, [&] { read_exr(hollow("b.exr", "", huge)); });
}

TEST_F(HostileInput, ExrHeadersAreHeldAgainstTheFileAndTheLimit) {
  write_exr(folder / "a.exr", FloatMap(31, 29, 1, 0.5f));
  const std::string bytes = read("a.exr");
  EXPECT_EQ(parse_exr(bytes, "a.exr", kLimit), FloatMap(31, 29, 1, 0.5f));
  const auto with = [&](const std::string& attribute, std::size_t at, std::int32_t value) {
    std::string lies = bytes;
    std::memcpy(&lies[bytes.find(attribute) + attribute.size() + at], &value, sizeof value);
    return lies;
  };
  // Name, type, size; then left, top, right, bottom.
  const std::string window("dataWindow\0box2i\0", 17);
  for (const std::int32_t right : {-1, 1 << 21, INT32_MAX, INT32_MIN})
    expect_bad({"a.exr", "size"}, [&] { parse_exr(with(window, 4 + 8, right), "a.exr", kLimit); });
  expect_bad({"a.exr", "cut short", "31×900000"},
             [&] { parse_exr(with(window, 4 + 12, 899999), "a.exr", 1e12); });
  expect_bad({"a.exr", "900000×29", "limit"},
             [&] { parse_exr(with(window, 4 + 8, 899999), "a.exr", kLimit); });
  // An attribute of another size than its type has, which the library would not look at.
  expect_bad({"a.exr", "damaged"},
             [&] { parse_exr(with("screenWindowWidth", 1 + 6, 5), "a.exr", kLimit); });
  // An attribute that is larger than the file.
  expect_bad({"a.exr", "cut short"},
             [&] { parse_exr(with(window, 0, INT32_MAX), "a.exr", kLimit); });
}

/// Datasets that hold less than they state.
class HostileHdf5 : public HostileInput {
 protected:
  template <class Prepare>
  void dataset(const std::string& name, const std::vector<hsize_t>& sizes, Prepare prepare) const {
    const hid_t file = H5Fcreate((folder / name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    prepare(file, creation);
    const std::vector<hsize_t> most(sizes.size(), H5S_UNLIMITED);
    const bool chunked = H5Pget_layout(creation) == H5D_CHUNKED;
    const hid_t space =
        H5Screate_simple(int(sizes.size()), sizes.data(), chunked ? most.data() : nullptr);
    const hid_t data =
        H5Dcreate2(file, "LF", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (data >= 0) H5Dclose(data);
    H5Sclose(space);
    H5Pclose(creation);
    H5Fclose(file);
  }
  static void chunks(hid_t creation, const std::vector<hsize_t>& sizes) {
    H5Pset_chunk(creation, int(sizes.size()), sizes.data());
  }
  void expect_bad_file(const std::string& name, const std::vector<std::string>& parts) const {
    expect_bad(parts, [&] { open_light_field(folder / name, within(kLimit)); });
  }
};

TEST_F(HostileHdf5, ValuesThatWereNeverWrittenAreNone) {
  dataset("a.mat", {3, 1000, 1000, 9, 9}, [](hid_t, hid_t creation) {
    chunks(creation, {3, 64, 64, 9, 9});
  });
  dataset("a.h5", {9, 9, 9000, 9000, 3}, [](hid_t, hid_t creation) {
    chunks(creation, {1, 1, 64, 64, 3});
  });
  for (const char* name : {"a.mat", "a.h5"}) {
    EXPECT_LT(std::filesystem::file_size(folder / name), 8000u);
    expect_bad_file(name, {name, "LF", "damaged"});
  }
}

TEST_F(HostileHdf5, ChunksAreHeldAgainstTheLimit) {
  dataset("a.h5", {3, 3, 17, 23, 3}, [](hid_t, hid_t creation) {
    chunks(creation, {1, 1, 9000, 9000, 3});
    H5Pset_deflate(creation, 9);
  });
  expect_bad_file("a.h5", {"a.h5", "17", "limit"});
}

TEST_F(HostileHdf5, OtherFilesAreNotFollowed) {
  pipe("pipe");
  dataset("outside.h5", {3, 3, 17, 23, 3},
          [](hid_t, hid_t creation) { H5Pset_external(creation, "/dev/zero", 0, H5F_UNLIMITED); });
  expect_bad_file("outside.h5", {"outside.h5", "another file"});
  const hid_t file =
      H5Fcreate((folder / "link.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_external((folder / "pipe").c_str(), "/LF", file, "LF", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  expect_bad_file("link.h5", {"link.h5", "no dataset LF"});
}

/// .grl files with right checksums and wrong sizes.
class HostileSparseFile : public HostileInput {
 protected:
  std::filesystem::path container(int width, int height, const std::string& tuples,
                                  const std::string& difference) const {
    SectionWriter file(AtomicFile(folder / "a.grl"));
    const auto add = [&](const std::string& bytes) {
      const Section section = file.add(bytes);
      return nlohmann::json{section.offset, section.size, section.checksum};
    };
    nlohmann::json root{{"kind", "3D"},          {"width", width},     {"height", height},
                        {"bit_depth", 8},        {"max_error", 0},     {"slope_bits", 5},
                        {"slope_tolerance", 32}, {"band_rows", height}};
    root["views"] = {{{"name", "a"}, {"s", -0.5}, {"t", 0}}, {{"name", "b"}, {"s", 0.5}, {"t", 0}}};
    root["tuples"] = nlohmann::json::array();
    root["tuples"].push_back(nlohmann::json::array({add(tuples), 0, 1}));
    for (int view = 0; view < 2; ++view)
      root["differences"].push_back(nlohmann::json::array({add(difference)}));
    file.finish(compressed(root.dump()), RunControl());
    return folder / "a.grl";
  }
};

TEST_F(HostileSparseFile, PicturesLargerThanTheirBytesAreDamaged) {
  expect_bad({"a.grl", "damaged", "1048576×1048576"},
             [&] { SparseFile{container(1 << 20, 1 << 20, "", std::string(500, '\0'))}; });
  expect_bad({"a.grl", "30000×2000", "limit"}, [&] {
    SparseFile{container(30000, 2000, "", std::string(50000, '\0')), kLimit};
  });
}

TEST_F(HostileSparseFile, BlocksAreHeldAgainstTheirFramesAndTheLimit) {
  const auto number = [](std::uint64_t value) {
    std::string text;
    for (; value >= 0x80; value >>= 7) text += char(value | 0x80);
    return text + char(value);
  };
  const std::string zeros = compressed(std::string(100 * 1024 * 1024, '\0'));
  ASSERT_LT(zeros.size(), 20000u);
  // A count of tuples that the picture allows, and blocks of zeros that the limit does not.
  std::string tuples = number(6'000'000);
  for (int column = 0; column < 7; ++column) tuples += zeros;
  const auto path = container(2000, 2000, tuples, std::string(9000, '\0'));
  const SparseFile file(path, 4 * kLimit);
  expect_bad({"a.grl"}, [&] { file.tuples(); });
  // The frame has 3 bytes, the block says it has 2^40.
  const std::string frame = compressed("abc").substr(1);
  expect_bad({"another size"},
             [&] { decompressed(number(std::uint64_t(1) << 40) + frame, std::size_t(1) << 41); });
  expect_bad({"too large"}, [&] { decompressed(number(1 << 20) + frame, 1 << 19); });
}

TEST_F(HostileSparseFile, DirectoriesAreHeldAgainstTheLimit) {
  SectionWriter file(AtomicFile(folder / "a.grl"));
  std::string text = "[0";
  for (int i = 0; i < 2'000'000; ++i) text += ",0";
  file.finish(compressed(text + "]"), RunControl());
  expect_bad({"a.grl", "values", "limit"}, [&] { SparseFile(folder / "a.grl", kLimit); });
}

TEST_F(HostileInput, ColmapModelsAreHeldAgainstTheLimit) {
  write("cameras.bin", std::string(8, '\0'));
  hollow("images.bin", "", std::uintmax_t(1) << 42);
  expect_bad({"images.bin", "limit"}, [&] { open_light_field(folder); });
  const std::uint64_t count = std::uint64_t(1) << 61;
  write("images.bin", std::string(reinterpret_cast<const char*>(&count), 8) + std::string(99, 'x'));
  expect_bad({"images.bin", "more than fit"}, [&] { open_light_field(folder); });
}

TEST_F(HostileInput, ResultsStateSizesThatAreOnes) {
  const auto result = [](double width) {
    return nlohmann::json{
        {"format", "gigaray depth"},
        {"input", "x"},
        {"light_field", {{"format", "f"}, {"kind", "3D"}, {"width", width}, {"height", 17}}},
        {"options", {{"disparity_range", {0, 1}}}},
        {"views", {{{"name", "a"}, {"s", 0}, {"t", 0}}}}}
        .dump();
  };
  EXPECT_EQ(parse_depth_json(result(23), "a").light_field.width, 23);
  for (const double width : {0.0, -1.0, 1e300, 2.5, 3e9})
    expect_bad({"a: ", "width"}, [&] { parse_depth_json(result(width), "a"); });
}

}  // namespace
}  // namespace gigaray
