// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/run.hpp"

#include "palpable/cli/help_format.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/cli/input_files.hpp"
#include "palpable/cli/program.hpp"
#include "palpable/cli/reader_watch.hpp"
#include "palpable/cli/suggest.hpp"
#include "palpable/core/text/passwords.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <span>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <glog/logging.h>
#include <pthread.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

/// Makes a single line of a sentence that may quote an argument, and shortens it in the middle.
std::string one_line(std::string sentence) {
  constexpr std::size_t kLongest = 1200, kKept = 500;
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  if (sentence.size() <= kLongest) return sentence;
  // Do not split a character: continuation bytes of UTF-8 begin with the bits 10.
  const auto goes_on = [&](std::size_t k) {
    return (static_cast<unsigned char>(sentence[k]) & 0xC0U) == 0x80U;
  };
  std::size_t end = kKept, begin = sentence.size() - kKept;
  while (end > 0 && goes_on(end)) --end;
  while (begin < sentence.size() && goes_on(begin)) ++begin;
  return sentence.substr(0, end) + " ... " + sentence.substr(begin);
}

int report(const Error& error) {
  write_error(one_line("palpable: " + sentence_of(error)) + "\n");
  return static_cast<int>(error.code);
}

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unknown_option(const std::string& typed, const CLI::App& command) {
  const auto meant = suggestion(typed.substr(0, typed.find('=')), option_names(command));
  return fmt::format("{} has no option {}{}", command.get_name(), typed,
                     meant ? fmt::format(": did you mean {}?", *meant)
                           : fmt::format(": {} lists its options", command.get_parent() != nullptr
                                                                       ? "palpable help " + command.get_name()
                                                                       : std::string("palpable help")));
}

std::string unknown_command(const std::string& typed, const std::vector<std::string>& known) {
  const std::string sentence = fmt::format("there is no command {}", typed);
  if (const auto meant = suggestion(typed, known))
    return fmt::format("{}: did you mean {}?", sentence, *meant);
  return fmt::format("{}: palpable help lists them", sentence);
}

/// The innermost command that the arguments named.
const CLI::App& chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : chosen_command(*chosen.front());
}

/// CLI11's error as one sentence.
Error explained(const CLI::App& app, const CLI::ParseError& complaint) {
  const CLI::App& command = chosen_command(app);
  const auto extras = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&complaint) != nullptr && !extras.empty()) {
    const std::string& typed = extras.front();
    if (typed.starts_with("-")) return usage(unknown_option(typed, command));
    const auto below = command_names(command);
    if (!below.empty()) return usage(unknown_command(typed, below));
    return usage(fmt::format("{} takes no argument {}", command.get_name(), typed));
  }
  std::string sentence = complaint.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&complaint) != nullptr)
    sentence = mismatch_sentence(sentence);
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  return usage(command.get_name().empty() ? sentence : command.get_name() + ": " + sentence);
}

/// An answer's text, which may have several lines, with the output's name on one.
std::string text_of(const Answer& answer) {
  std::string text = answer.text;
  const auto output = answer.json.find("output");
  if (output == answer.json.end() || !output->is_string()) return without_control_characters(text);
  const auto name = output->get<std::string>();
  if (const std::string plain = one_line(name); plain != name)
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + plain.size()))
      text.replace(at, name.size(), plain);
  return without_control_characters(text);
}

int finish(const Result<Answer>& answer, const CommonOptions& common) {
  if (!answer) {
    ProgressLines(common.progress_to).error(one_line(sentence_of(answer.error())));
    return report(answer.error());
  }
  const std::string text = common.json
                               ? answer->json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"
                               : text_of(*answer);
  if (const auto printed = print(text); !printed) return report(printed.error());
  return answer->exit_code;
}

bool writes_files(const Program& program) {
  const CLI::App* const command = &chosen_command(program.app);
  return std::any_of(program.outputs.begin(), program.outputs.end(), [command](const OutputOption& output) {
    return output.command == command && output.option->count() > 0;
  });
}

/// The folder of the samples if the command reads one of them: it names one, or is a touch without an input.
std::vector<std::filesystem::path> samples_of(const CLI::App& command) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      arguments.insert(arguments.end(), option->results().begin(), option->results().end());
  const bool reads_one =
      arguments.empty() ? command.get_name() == "touch"
                        : std::any_of(arguments.begin(), arguments.end(),
                                      [](const std::string& one) { return one.starts_with(kSamplePrefix); });
  return reads_one ? sample_folders() : std::vector<std::filesystem::path>();
}

int parse_and_run(int argc, char** argv) {
  Program program;
  add_commands(program);
  for (int k = 1; k < argc; ++k) program.common.command.push_back(without_passwords(argv[k]));
  try {
    program.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return finish(Answer{{}, program.app.help()}, {});
  } catch (const CLI::CallForVersion&) {
    return finish(Answer{{}, program.app.version() + "\n"}, {});
  } catch (const CLI::ParseError& complaint) {
    return report(explained(program.app, complaint));
  }
  const CLI::App& command = chosen_command(program.app);
  if (auto writable = check_outputs(command, program.outputs, samples_of(command)); !writable)
    return report(writable.error());
  if (!ProgressLines::can_write_to(program.common.progress_to))
    return report(usage(fmt::format("--progress-to: nothing can be written to the descriptor {}",
                                    program.common.progress_to)));
  if (!program.action) program.action = home_action();
  auto answer = [&program] {
    const ReaderWatch reader(program.common.progress_to);
    // Its destructor removes the progress line.
    Console console(program.common);
    return program.action(console);
  }();
  // After Ctrl-C no file is put in place, so an answer of a command that writes files means that all of them
  // were complete before. Without files nothing shows whether the work was cut short.
  const bool says_so = answer && answer->exit_code == static_cast<int>(ErrorCode::interrupted);
  const bool is_complete = answer && writes_files(program);
  if (interrupted() && !says_so && !is_complete) return report(Work::interrupted());
  return finish(answer, program.common);
}

}  // namespace

Result<Answer> run_command(const std::vector<std::string>& words,
                           std::span<const std::filesystem::path> inputs, const CommonOptions& from) {
  Program program;
  add_commands(program);
  std::transform(words.begin(), words.end(), std::back_inserter(program.common.command), without_passwords);
  try {
    // The library takes them from the last one on.
    program.app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success&) {
    return usage("it only asks for help");
  } catch (const CLI::ParseError& complaint) {
    return explained(program.app, complaint);
  }
  const CLI::App& command = chosen_command(program.app);
  for (const OutputOption& output : program.outputs)
    if (output.command == &command && output.option->count() > 0 && output.option->get_name() != "--output")
      return usage(fmt::format("{} writes a file, and only --output may", output.option->get_name()));
  const InputFiles named(input_words(command, program.outputs));
  for (const auto& file : named.regular_files(InputFiles::Folders::left_out))
    if (std::none_of(inputs.begin(), inputs.end(), [&file](const std::filesystem::path& input) {
          std::error_code none;
          return std::filesystem::equivalent(file, input, none);
        }))
      return usage(fmt::format("it reads {}, which is not among its files", file.string()));
  if (auto writable = check_outputs(command, program.outputs, samples_of(command)); !writable)
    return std::move(writable).error();
  program.common.json = from.json;
  program.common.quiet = from.quiet;
  program.common.threads = from.threads;
  program.common.progress_to = from.progress_to;
  Console console(program.common);
  return program.action(console);
}

Result<std::string> help_text(const Program& program, const std::vector<std::string>& words) {
  const CLI::App* app = &program.app;
  // The help of the program, not of the command `help`.
  if (words.empty()) return app->get_formatter()->make_help(app, app->get_name(), CLI::AppFormatMode::Normal);
  std::string before;
  for (const std::string& word : words) {
    const auto below = command_names(*app);
    if (std::find(below.begin(), below.end(), word) == below.end())
      return usage(unknown_command(word, below));
    before += (before.empty() ? "" : " ") + app->get_name();
    app = app->get_subcommand(word);
  }
  return app->help(before);
}

/// Opens /dev/null for closed standard streams; otherwise the next opened file would receive their text.
static void keep_standard_streams() {
  for (int at = 0; at >= 0 && at <= STDERR_FILENO;) {
    at = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (at > STDERR_FILENO) close(at);
  }
}

/// Threads get a usual stack whatever `ulimit -s` says, which holds for the main thread.
static void give_threads_room() {
  constexpr std::size_t kStack_bytes = 8U << 20U;
  pthread_attr_t usual;
  if (pthread_attr_init(&usual) != 0) return;
  if (pthread_attr_setstacksize(&usual, kStack_bytes) == 0) pthread_setattr_default_np(&usual);
  pthread_attr_destroy(&usual);
}

int run(int argc, char** argv) {
  give_threads_room();
  // First of all: a signal that finds no handler ends the program without a sentence.
  catch_interrupts();
  keep_standard_streams();
  // Ceres logs warnings that nobody can act on to the terminal.
  FLAGS_minloglevel = google::GLOG_FATAL;
  try {
    return parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    return report({ErrorCode::failed, "there is not enough memory for this", {}});
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      return report({ErrorCode::failed, "the system gives no further thread or process (ulimit -u)", {}});
    return report({ErrorCode::failed, error.what(), {}});
  } catch (const std::exception& exception) {
    return report({ErrorCode::failed, fmt::format("this is a bug in palpable: {}", exception.what()), {}});
  }
}

}  // namespace palpable::cli
