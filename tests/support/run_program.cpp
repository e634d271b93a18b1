#include "tests/support/run_program.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scree::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
    int read_end = -1;
    int write_end = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("cannot make a pipe");
        read_end = ends[0];
        write_end = ends[1];
    }
    ~Pipe() {
        ::close(read_end);
        if (write_end >= 0)
            ::close(write_end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
};

[[noreturn]] void become(const std::filesystem::path& program, std::vector<char*>& words,
                         const ProgramSetup& setup, const Pipe& output, const Pipe& errors) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(output.write_end, STDOUT_FILENO);
    ::dup2(errors.write_end, STDERR_FILENO);
    if (!setup.folder.empty() && ::chdir(setup.folder.c_str()) != 0)
        ::_exit(126);
    if (setup.largest_file >= 0) {
        const auto bytes = static_cast<rlim_t>(setup.largest_file);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ::execv(program.c_str(), words.data());
    ::_exit(127);
}

int milliseconds_since(Clock::time_point start) {
    return static_cast<int>(
        std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count());
}

// Read both pipes until the program closes them, sending what was asked for on the way.
void listen(pid_t process, const ProgramSetup& setup, const Pipe& output, const Pipe& errors,
            ProgramRun& run) {
    const auto start = Clock::now();
    bool interrupted = setup.interrupt_after_ms < 0;
    bool killed = false;
    std::array<pollfd, 2> ends = {{{output.read_end, POLLIN, 0}, {errors.read_end, POLLIN, 0}}};
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        const int now = milliseconds_since(start);
        if (!interrupted && now >= setup.interrupt_after_ms)
            interrupted = ::kill(process, SIGINT) == 0;
        if (!killed && now >= setup.timeout_ms)
            killed = ::kill(process, SIGKILL) == 0;
        ::poll(ends.data(), ends.size(), 5);
        for (std::size_t i = 0; i < 2; ++i) {
            if (ends[i].fd < 0 || (ends[i].revents & (POLLIN | POLLHUP)) == 0)
                continue;
            std::array<char, 4096> block{};
            const ssize_t n = ::read(ends[i].fd, block.data(), block.size());
            if (n <= 0)
                ends[i].fd = -1;
            else
                (i == 0 ? run.output : run.errors)
                    .append(block.data(), static_cast<std::size_t>(n));
        }
    }
}

}  // namespace

ProgramRun run_program(const std::filesystem::path& program, const std::vector<std::string>& words,
                       const ProgramSetup& setup) {
    std::vector<std::string> all = {program.string()};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& word : all)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);

    Pipe output;
    Pipe errors;
    const pid_t process = ::fork();
    if (process < 0)
        throw std::runtime_error("cannot start " + program.string());
    if (process == 0)
        become(program, pointers, setup, output, errors);
    for (Pipe* pipe : {&output, &errors}) {
        ::close(pipe->write_end);
        pipe->write_end = -1;
    }
    ProgramRun run;
    listen(process, setup, output, errors, run);
    int status = 0;
    ::waitpid(process, &status, 0);
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return run;
}

}  // namespace scree::test
