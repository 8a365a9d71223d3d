// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

namespace palpable::test {
namespace {

std::filesystem::path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "palpable-e2e-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
  return name;
}

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status); }

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const std::string& input,
                 const std::string& error, Hangup hangup)
    : folder_(new_folder()) {
  std::vector<std::string> words{PALPABLE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder_ / "out").c_str(), kWrite, 0600);
  const std::string err = error.empty() ? (folder_ / "err").string() : error;
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), kWrite, 0600);
  // Whatever the tests themselves were started with, nohup for example.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t by_default;
  sigemptyset(&by_default);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&by_default, signal);
  if (hangup == Hangup::by_default) sigaddset(&by_default, SIGHUP);
  posix_spawnattr_setsigdefault(&attributes, &by_default);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const auto own = hangup == Hangup::ignored ? std::signal(SIGHUP, SIG_IGN) : SIG_ERR;
  const int fault = posix_spawn(&pid_, PALPABLE_PROGRAM, &actions, &attributes, argv.data(), environ);
  if (own != SIG_ERR) std::signal(SIGHUP, own);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) throw std::runtime_error("the program cannot be started");
}

Running::~Running() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::filesystem::remove_all(folder_);
}

void Running::send(int signal) const { kill(pid_, signal); }

bool Running::catches(int signal, std::chrono::seconds patience) const {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    // The process's caught signals, as a hexadecimal mask.
    const std::string status = read_text("/proc/" + std::to_string(pid_) + "/status");
    const auto at = status.find("SigCgt:");
    if (at != std::string::npos &&
        (std::stoull(status.substr(at + 7), nullptr, 16) >> static_cast<unsigned>(signal - 1) & 1U) != 0)
      return true;
    usleep(2000);
  }
  return false;
}

bool Running::works(std::chrono::seconds processor_time, std::chrono::seconds patience) const {
  // A timer on the program's own processor clock wakes this thread; so does the program's end.
  sigset_t wanted;
  sigemptyset(&wanted);
  sigaddset(&wanted, SIGRTMIN);
  sigaddset(&wanted, SIGCHLD);
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &wanted, &before);
  bool worked = false;
  clockid_t clock{};
  timer_t timer{};
  sigevent wake{};
  wake.sigev_notify = SIGEV_SIGNAL;
  wake.sigev_signo = SIGRTMIN;
  if (clock_getcpuclockid(pid_, &clock) == 0 && timer_create(clock, &wake, &timer) == 0) {
    const itimerspec used{{}, {processor_time.count(), 0}};
    const timespec longest{patience.count(), 0};
    if (timer_settime(timer, TIMER_ABSTIME, &used, nullptr) == 0)
      worked = sigtimedwait(&wanted, nullptr, &longest) == SIGRTMIN;
    timer_delete(timer);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return worked;
}

std::string Running::out() const { return read_text(folder_ / "out"); }
std::string Running::err() const { return read_text(folder_ / "err"); }

bool Running::says(const std::string& text, std::chrono::seconds patience) const {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    if ((out() + err()).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

Outcome Running::wait(std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      ADD_FAILURE() << "the program did not end; it said: " << err();
      kill(pid_, SIGKILL);
      waitpid(pid_, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  pid_ = -1;
  return {exit_code_of(status), out(), err()};
}

Outcome palpable(const std::vector<std::string>& arguments) { return Running(arguments).wait(); }

Outcome palpable_on_a_terminal(const std::vector<std::string>& arguments) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0)
    throw std::runtime_error("no terminal for a test");
  const std::string name = ptsname(master);
  // Kept open, so that the output stays readable after the program's end; raw, so that it is not translated.
  const int slave = open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  tcgetattr(slave, &settings);
  cfmakeraw(&settings);
  tcsetattr(slave, TCSANOW, &settings);
  std::string err;
  Outcome outcome;
  {
    Running running(arguments, "/dev/null", name);
    std::jthread reader([&](const std::stop_token& ended) {
      pollfd wait{master, POLLIN, 0};
      while (poll(&wait, 1, 20) > 0 || !ended.stop_requested()) {
        std::array<char, 4096> bytes{};
        if ((wait.revents & POLLIN) == 0) continue;
        const ssize_t count = read(master, bytes.data(), bytes.size());
        if (count > 0) err.append(bytes.data(), static_cast<std::size_t>(count));
      }
    });
    outcome = running.wait();
  }
  outcome.err = err;
  close(slave);
  close(master);
  return outcome;
}

void InFolder::SetUp() {
  folder_ = new_folder();
  // Isolates the test from other tests and from the user's files.
  setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
}
void InFolder::TearDown() { std::filesystem::remove_all(folder_); }

void write_text(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string read_text(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

testing::AssertionResult is_one_sentence(const std::string& err) {
  if (!err.starts_with("palpable: "))
    return testing::AssertionFailure() << "does not begin with the name: " << err;
  if (std::count(err.begin(), err.end(), '\n') != 1 || err.back() != '\n')
    return testing::AssertionFailure() << "is not one line: " << err;
  return testing::AssertionSuccess();
}

}  // namespace palpable::test
