#include "modeler/tetgen_process.hh"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "modeler/tetgen_worker/status.hh"
#include "volmesh/error.hh"

extern char** environ;

namespace maille::modeler::tetgen {
namespace {

using Clock = std::chrono::steady_clock;

class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {
        if (number < 0) throw Failure(fmt::format("no file descriptor for TetGen: {}", std::strerror(errno)));
    }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() { close(); }

    int number() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(std::exchange(number_, -1));
    }

  private:
    int number_;
};

Descriptor memory_file(const char* name) {
    return Descriptor(memfd_create(name, MFD_CLOEXEC));
}

void write_all(int descriptor, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw Failure(fmt::format("TetGen's input could not be stored: {}", std::strerror(errno)));
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

/// The last line that the worker printed.
std::string last_words(int log) {
    std::array<char, 1000> text{};
    const off_t size = lseek(log, 0, SEEK_END);
    const off_t start = std::max<off_t>(0, size - static_cast<off_t>(text.size()));
    const ssize_t n = pread(log, text.data(), text.size(), start);
    std::string words(text.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    words.erase(words.find_last_not_of(" \n\t") + 1);
    if (const auto line = words.rfind('\n'); line != std::string::npos) words.erase(0, line + 1);
    return words.empty() ? "" : fmt::format(" ({})", words);
}

/// A child process: killed and reaped at the latest when this goes.
class Child {
  public:
    Child(const std::filesystem::path& program, int input, int log, int answer) {
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, log, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, log, STDERR_FILENO);
        posix_spawn_file_actions_adddup2(&actions, answer, answer_descriptor);
        std::string name = program.string();
        std::array<char*, 2> arguments{name.data(), nullptr};
        const int error = posix_spawn(&id_, name.c_str(), &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0)
            throw InputError(
                fmt::format("cannot start {}: {}; set MAILLE_TETGEN to the path of maille-tetgen", name,
                            std::strerror(error)));
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (running_) {
            kill(id_, SIGKILL);
            waitpid(id_, nullptr, 0);
        }
    }

    /// Its status as waitpid() gives it, or nothing where it has not ended by then.
    std::optional<int> wait_until(Clock::time_point deadline) {
        using namespace std::chrono_literals;
        for (auto pause = 100us;; pause = std::min<decltype(pause)>(2 * pause, 20ms)) {
            int status = 0;
            const pid_t ended = waitpid(id_, &status, WNOHANG);
            if (ended == id_) {
                running_ = false;
                return status;
            }
            if (Clock::now() > deadline) return std::nullopt;
            std::this_thread::sleep_for(pause);
        }
    }

  private:
    pid_t id_ = -1;
    bool running_ = true;
};

/// Everything up to the end of the pipe, or nothing where that has not come by then.
std::optional<std::vector<char>> read_until(int pipe, Clock::time_point deadline) {
    std::vector<char> bytes;
    std::vector<char> buffer(1 << 20);
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return std::nullopt;
        pollfd ready{pipe, POLLIN, 0};
        if (poll(&ready, 1, static_cast<int>(std::min<long>(left, 1'000'000))) <= 0) continue;
        const ssize_t n = read(pipe, buffer.data(), buffer.size());
        if (n == 0) return bytes;
        if (n > 0) bytes.insert(bytes.end(), buffer.data(), buffer.data() + n);
    }
}

std::string error_words(int number) {
    switch (number) {
        case 1:
            return "ran out of memory";
        case 2:
            return "met an internal error";
        case 3:
            return "found that the surface crosses itself";
        case 4:
            return "found a feature too small for it";
        case 5:
            return "found two facets too close to each other";
        case 10:
            return "refused its input";
        default:
            return fmt::format("stopped with error {}", number);
    }
}

bool is_at_time_limit(int status) {
    return WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
}

/// Why the process is no good, or nothing where it ended as it should.
std::string reason(int status) {
    if (WIFSIGNALED(status)) return fmt::format("TetGen crashed ({})", strsignal(WTERMSIG(status)));
    const int code = WEXITSTATUS(status);
    if (code > tetgen_error_status) return "TetGen " + error_words(code - tetgen_error_status);
    return code == 0 ? "" : fmt::format("maille-tetgen ended with status {}", code);
}

bool is_executable(const std::filesystem::path& path) {
    return access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::filesystem::path find_worker() {
    if (const char* given = std::getenv("MAILLE_TETGEN"); given != nullptr && *given != '\0') {
        if (is_executable(given)) return given;
        throw InputError(fmt::format("MAILLE_TETGEN names no program that can be run: {}", given));
    }
    std::error_code ignored;
    const auto here = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    const std::array<std::filesystem::path, 4> places{here / "maille-tetgen",
                                                      here / "../libexec/maille/maille-tetgen",
                                                      MAILLE_TETGEN_BUILT, MAILLE_TETGEN_INSTALLED};
    const auto found = std::ranges::find_if(places, is_executable);
    if (found != places.end()) return *found;
    throw InputError(fmt::format("maille-tetgen not found at {}, {}, {} or {}; set MAILLE_TETGEN to its path",
                                 places[0].string(), places[1].string(), places[2].string(),
                                 places[3].string()));
}

Answer run(const Request& request) {
    const auto seconds = std::chrono::duration<double>(4 * request.processor_time);
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(seconds);
    Packer packer;
    visit_request(packer, request);
    const Descriptor input = memory_file("maille-tetgen-input");
    write_all(input.number(), packer.bytes);
    lseek(input.number(), 0, SEEK_SET);
    const Descriptor log = memory_file("maille-tetgen-log");
    std::array<int, 2> pipe_ends{-1, -1};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
        throw Failure(fmt::format("no pipe for TetGen: {}", std::strerror(errno)));
    const Descriptor answer_end(pipe_ends[0]);
    Descriptor worker_end(pipe_ends[1]);

    Child child(find_worker(), input.number(), log.number(), worker_end.number());
    worker_end.close();
    const auto bytes = read_until(answer_end.number(), deadline);
    const auto status = bytes ? child.wait_until(deadline) : std::nullopt;
    if (!status)
        throw TimeOut(fmt::format("TetGen gave no answer within {:.3g} seconds{}", seconds.count(),
                                  last_words(log.number())));
    if (is_at_time_limit(*status))
        throw TimeOut(fmt::format("TetGen was ended at its time limit{}", last_words(log.number())));
    if (const std::string words = reason(*status); !words.empty())
        throw Failure(words + last_words(log.number()));

    Answer answer;
    try {
        Unpacker unpacker(*bytes);
        visit_answer(unpacker, answer);
    } catch (const std::runtime_error&) {
        throw Failure("TetGen's answer is incomplete" + last_words(log.number()));
    }
    return answer;
}

}  // namespace maille::modeler::tetgen
