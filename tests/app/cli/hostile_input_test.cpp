#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

// Tests with malicious files: for each, the command must end within two seconds, use at most 256
// MiB and print a one-line reason.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string repeated(int count, const std::function<std::string(int)>& part) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part(i);
  }
  return text;
}
std::string repeated(int count, const std::string& part) {
  return repeated(count, [&](int /*i*/) { return part; });
}

//! The result of a command.
struct Outcome {
  int status = -1;  //!< -1: killed by a signal
  double seconds = 0.0;
  double mebibytes = 0.0;
  std::string errors;  //!< content of the command's standard error
};

class HostileInput : public test::FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments) const {
    const fs::path errors = folder_ / "errors";
    std::vector<std::string> words = {ERGODOME_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    std::ranges::transform(words, std::back_inserter(pointers), [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
    const auto begin = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
      const int to = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(::open("/dev/null", O_RDWR), STDOUT_FILENO);
      ::dup2(to, STDERR_FILENO);
      static_cast<void>(::chdir(folder_.c_str()));
      ::alarm(60);
      ::execv(pointers[0], pointers.data());
      ::_exit(127);
    }
    int status = 0;
    rusage used = {};
    ::wait4(child, &status, 0, &used);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    const auto seconds_of = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    // On a busy machine, the elapsed time includes waiting for a CPU, so the CPU time counts if it
    // is shorter. A command that hangs without using the CPU is killed by the alarm.
    const double seconds = std::min(elapsed.count(), seconds_of(used.ru_utime) + seconds_of(used.ru_stime));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds, static_cast<double>(used.ru_maxrss) / 1024.0,
            text("errors")};
  }

  //! Runs a command on a file that it must refuse, and checks its time and memory. The error
  //! message must contain `says`.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& says) const {
    const std::string command = fmt::format("{}", fmt::join(arguments, " "));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << command << "\n" << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(says)) << command;
    EXPECT_EQ(std::ranges::count(outcome.errors, '\n'), 1) << command << "\n" << outcome.errors;
    if (!test::sanitized) {
      EXPECT_LT(outcome.seconds, 2.0) << command;
      EXPECT_LT(outcome.mebibytes, idle_mebibytes_ + 256.0) << command;
    }
  }

  //! Checks that a show is refused because of a file that it refers to. `show` contains lines of
  //! the show, including the key that names the file.
  void expect_refused_in_show(const std::string& show, const std::string& file, const std::string& why) const {
    write("show.toml", "[hole]\nspin = 0\n[[camera.key]]\nr = 60\n" + show);
    expect_refused({"render", "show.toml", "--out", "frames", "--frames", "1:1", "--size", "16", "--backend", "cpu"},
                   why);
    EXPECT_THAT(text("errors"), HasSubstr(file));
  }
  void expect_mesh_refused(const std::string& file, const std::string& why) const {
    expect_refused_in_show(fmt::format("[[objects]]\nmesh = \"{}\"\nposition = [40, 0, 0]\nmethod = \"trace\"\n", file),
                           file, why);
  }
  void expect_map_refused(const std::string& file, const std::string& why) const {
    expect_refused_in_show(fmt::format("[sky]\nmap = \"{}\"\n", file), file, why);
  }

  double idle_mebibytes_ = run({"--version"}).mebibytes;
};

//! TOML text that is nested too deeply, has too many keys, or would keep the parser busy for
//! minutes.
struct HostileToml {
  std::string text;
  std::string why;
};

std::vector<HostileToml> hostile_toml() {
  const auto key = [](int i) { return "k" + std::to_string(i); };
  return {
      {"a" + repeated(27'700, ".a") + " = 1\n", "more than 16 parts"},
      {"[a" + repeated(27'700, ".a") + "]\n", "more than 16 parts"},
      {"a = " + std::string(100'000, '[') + std::string(100'000, ']') + "\n", "deeper than 32 levels"},
      {"a = " + repeated(100'000, "{a=") + "1" + std::string(100'000, '}') + "\n", "deeper than 32 levels"},
      {"a = [" + repeated(450'000, "0,") + "]\nb = [" + repeated(600'000, "0,") + "]\n", ""},
      {repeated(40'000, [&](int i) { return key(i) + ".a=1\n"; }) +
           repeated(40'000, [&](int i) { return key(i) + ".b=1\n"; }),
       ""},
      {repeated(40'000, [&](int i) { return "[[" + key(i) + "]]\n"; }) +
           repeated(40'000, [&](int i) { return "[[" + key(i) + ".b]]\n"; }),
       ""},
      {std::string(900'000, 'a') + " = 1\n", ""},
      {"title = \"" + std::string(900'000, 'a') + "\"\n", ""},
      {"title = \"\\u001b[31m\"\n", ""},
      {std::string(900'000, '\0'), ""},
      {std::string(900'000, '"'), ""},
      {repeated(400'000, "#\n") + "=", ""},
  };
}

TEST_F(HostileInput, TomlIsRefusedByEveryReaderOfIt) {
  const std::string fixture = std::string(ERGODOME_TEST_DATA_DIR) + "/hid/flight.toml";
  for (const HostileToml& hostile : hostile_toml()) {
    write("hostile.toml", hostile.text);
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"inspect", "hostile.toml"},
             {"plan", "hostile.toml"},
             {"calibrate", "hostile.toml", "--out", "calibrated"},
             {"pad", "--live", "--for", "0.1", "--fixture", "hostile.toml"},
             {"pad", "--live", "--for", "0.1", "--fixture", fixture, "--settings", "hostile.toml"}}) {
      SCOPED_TRACE(hostile.text.substr(0, 40));
      expect_refused(command, hostile.why);
    }
  }
  expect_refused({"inspect", ERGODOME_TEST_DATA_DIR "/foreign/damaged/deep_settings.toml"}, "more than 16 parts");
}

TEST_F(HostileInput, MeshesAreRefused) {
  const std::string head =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"meshes":[{"primitives":[]}],)";
  write("nested.gltf", head + "\"extras\":" + std::string(174'000, '[') + std::string(174'000, ']') + "}");
  write("open.gltf", std::string(174'000, '['));
  write("nodes.gltf", head + "\"nodes\":[" + repeated(1'000'000, "{\"mesh\":0},") + "{}]}");
  write("values.gltf", head + "\"extras\":[" + repeated(5'000'000, "0,") + "0]}");
  write("roots.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + repeated(100'000, "0,") +
                          R"(0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[]}]})");
  expect_mesh_refused("nested.gltf", "deeper than 64 levels");
  expect_mesh_refused("open.gltf", "deeper than 64 levels");
  expect_mesh_refused("nodes.gltf", "more than 200000 objects");
  expect_mesh_refused("values.gltf", "more than 2000000 values");
  expect_mesh_refused("roots.gltf", "more than once in its tree");
  fs::copy_file(ERGODOME_TEST_DATA_DIR "/foreign/damaged/fan.gltf", folder_ / "fan.gltf");
  expect_mesh_refused("fan.gltf", "more than once in its tree");
  const std::string point = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  write("face.obj", repeated(600'000, [](int i) { return fmt::format("v {} {} 0\n", i, i * 7 % 1000); }) + "f" +
                        repeated(600'000, [](int i) { return fmt::format(" {}", i + 1); }) + "\n");
  write("faces.obj", repeated(1000, [](int i) { return fmt::format("v {} {} 0\n", i, i * 7 % 1000); }) +
                         repeated(2000, "f" + repeated(1000, [](int i) { return fmt::format(" {}", i + 1); }) + "\n"));
  write("materials.obj", point + repeated(500'000, [](int i) { return fmt::format("usemtl m{}\nf 1 2 3\n", i); }));
  write("libraries.obj", point + "f 1 2 3\nmtllib" + repeated(1'000'000, " a") + "\n");
  write("p.mtl", "newmtl a\nmap_Kd" + repeated(500'000, " x") + "\n");
  write("names.obj", "mtllib p.mtl\n" + point + "usemtl a\nf 1 2 3\n");
  write("blanks.obj", point + repeated(3'000'000, "f \\\n"));
  expect_mesh_refused("face.obj", "more than 1024 corners");
  expect_mesh_refused("faces.obj", "too many faces with many corners");
  expect_mesh_refused("materials.obj", "more than 10000 materials");
  expect_mesh_refused("libraries.obj", "refers to \"a\"");
  expect_mesh_refused("names.obj", "which is not in its folder");
  expect_mesh_refused("blanks.obj", "not a whole number");
}

TEST_F(HostileInput, ImagesAreRefused) {
  for (const char* const name : {"big.tif", "u0.tif", "u50.tif"}) {
    fs::copy_file(fs::path(ERGODOME_TEST_DATA_DIR "/foreign/damaged") / name, folder_ / name);
    expect_map_refused(name, "is truncated");
  }
  write("big.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 60000\n");
  write("big.ppm", "P6 60000 30000 255\n" + std::string(1000, '\0'));
  write("text.png", "not an image");
  ::mkfifo((folder_ / "pipe.png").c_str(), 0600);
  expect_map_refused("big.hdr", "claims 60000 x 30000 pixels");
  expect_map_refused("big.ppm", "claims 60000 x 30000 pixels");
  expect_map_refused("text.png", "cannot be read as an image");
  expect_map_refused("pipe.png", "is not a regular file");
}

TEST_F(HostileInput, TablesAreRefused) {
  write("columns.csv", "ra,dec,mag" + repeated(3'000'000, ",x") + "\n1,2\n");
  write("quote.csv", "ra,dec,mag\n1,2,\"" + std::string(20'000'000, 'a'));
  write("line.csv", std::string(20'000'000, ','));
  expect_refused({"catalogue", "quote.csv"}, "more than 64 KiB");
  for (const char* const name : {"quote.csv", "line.csv"}) {
    expect_refused({"trace", "--rays", name, "--out", "out.csv"}, name);
    expect_refused({"connect", "--pairs", name, "--out", "out.csv"}, name);
    expect_refused({"edge", "--rays", name, "--out", "out.csv"}, name);
  }
}

TEST_F(HostileInput, WarpsAreRefused) {
  write("big.pfm", "PF\n16000 2000\n-1.0\n");
  write("grid.data", "2\n10000 3000\n0 0 0 0 1\n");
  write("line.data", "2\n" + std::string(30'000'000, ' '));
  fs::copy_file(ERGODOME_TEST_DATA_DIR "/foreign/damaged/pfm_nan.pfm", folder_ / "nan.pfm");
  expect_refused({"convert", "big.pfm", "out.data"}, "bytes of samples");
  expect_refused({"convert", "nan.pfm", "out.data"}, "no sample with a finite position");
  expect_refused({"convert", "grid.data", "out.pfm"}, "grid.data");
  expect_refused({"convert", "line.data", "out.pfm"}, "line.data");
}

TEST_F(HostileInput, TrajectoriesAndCataloguesOfOursAreRefused) {
  write("a.trajectory", std::string(20'000'000, '\xFF'));
  write("a.stars", "EDSTARS" + std::string(20'000'000, '\xFF'));
  expect_refused({"inspect", "a.trajectory"}, "a.trajectory");
  expect_refused({"catalogue", "a.stars"}, "a.stars");
}

TEST_F(HostileInput, SoundsAreRefused) {
  write("show.toml", "duration_s = 10\n[hole]\nspin = 0\n[[camera.key]]\nr = 60\n[[audio]]\nfile = \"a.wav\"\n");
  for (const std::string& bytes :
       {std::string("RIFF\xFF\xFF\xFF\x7FWAVE") + repeated(1'000'000, std::string("LIST\0\0\0\0", 8)),
        std::string(20'000'000, '\xFF'), std::string("fLaC") + std::string(1'000'000, '\0'),
        std::string("OggS") + std::string(1'000'000, '\0')}) {
    write("a.wav", bytes);
    const Outcome outcome = run({"inspect", "show.toml"});
    EXPECT_EQ(outcome.status, 1) << outcome.errors;
    EXPECT_LT(outcome.seconds, test::sanitized ? 30.0 : 2.0);
    EXPECT_LT(outcome.mebibytes, idle_mebibytes_ + (test::sanitized ? 1e6 : 256.0));
  }
}

}  // namespace
}  // namespace ergodome
