// Kills `gyre scan` at random instants: every folder opens, and resuming gives the same points.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/random.h"
#include "core/io/scan_store.h"
#include "core/sim/rig_json.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

int fromEnvironment(const char* name, int otherwise) {
  const char* asked = std::getenv(name);
  return asked != nullptr ? std::atoi(asked) : otherwise;
}

int views() { return fromEnvironment("GYRE_KILL_VIEWS", 90); }

// Pictures that are on the disk, whole or not, with a line in the journal or without.
std::size_t picturesIn(const fs::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "frames")) {
    if (entry.path().filename().string().starts_with("view_")) ++count;
  }
  return count;
}

// Starts the program and does not wait.
pid_t start(const std::vector<std::string>& words) {
  std::vector<char*> arguments = {const_cast<char*>(GYRE_PROGRAM)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t pid = -1;
  GYRE_CHECK(posix_spawn(&pid, GYRE_PROGRAM, nullptr, nullptr, arguments.data(), environ) == 0);
  return pid;
}

// The exit code, or minus the signal that ended it.
int wait(pid_t pid) {
  int status = 0;
  GYRE_CHECK(waitpid(pid, &status, 0) == pid);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::vector<std::string> scanWords(const fs::path& rig, const fs::path& out) {
  return {"scan",    "--turntable",           "sim",         "--camera", "sim",     "--rig", rig,
          "--views", std::to_string(views()), "--sim-speed", "100",      "--quiet", "--out", out};
}

TEST(KilledScan, OpensAndResumesToTheSamePoints) {
  const TempDir temp;
  const fs::path rig = putFile(temp / "rig.json", rigToJson(atImageWidth(RigSettings{}, 320)));
  const double start_s = steadySeconds();
  const int whole_code = wait(start(scanWords(rig, temp / "whole")));
  const double whole_s = steadySeconds() - start_s;
  const std::string points = fileText(temp / "whole" / "points.ply");
  ASSERT_GT(points.size(), 1000U) << "exit code " << whole_code;

  const int kills = fromEnvironment("GYRE_KILLS", 6);
  int begun = 0;
  Random random(7);
  std::vector<bool> finished;  // the points were there before it was killed: nothing may be left
  // On a busy machine some are killed before they have begun: these do not count.
  for (int i = 0; begun < kills && i < 4 * kills; ++i) {
    const double instant_s = random.uniform(0.0, whole_s);
    const fs::path folder = temp / ("cut" + std::to_string(i));
    const pid_t pid = start(scanWords(rig, folder));
    std::this_thread::sleep_for(std::chrono::duration<double>(instant_s));
    kill(pid, SIGKILL);
    wait(pid);
    SCOPED_TRACE("killed after " + std::to_string(instant_s) + " s of " + std::to_string(whole_s));
    finished.push_back(false);
    if (!fs::exists(folder)) continue;
    ++begun;
    const auto opened = ScanStore::open(folder);
    ASSERT_TRUE(opened) << opened.error().sentence();
    EXPECT_LE(picturesIn(folder), opened->views().size() + 1) << "more than the view in flight";
    finished.back() = opened->complete() && fs::exists(folder / "points.ply");
  }
  EXPECT_EQ(begun, kills);
  for (std::size_t i = 0; i < finished.size(); ++i) {
    const fs::path folder = temp / ("cut" + std::to_string(i));
    if (!fs::exists(folder)) continue;
    const int code = wait(start({"resume", folder, "--sim-speed", "100", "--quiet"}));
    EXPECT_TRUE(code == whole_code || (finished[i] && code == 0)) << code;
    EXPECT_EQ(fileText(folder / "points.ply"), points) << folder;
  }
}

}  // namespace
}  // namespace gyre
