#include "apps/commands.h"
#include "apps/console.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace scree::apps {
namespace {

enum Status { kDone = 0, kFailed = 1, kWrongWords = 2, kInterrupted = 130 };

std::string overview() {
    std::string text =
        "scree: photographs into rocks, rocks into ground\n\nusage: scree COMMAND ...\n\n";
    for (const Command& command : commands())
        text += "  " + command.words.name + std::string(14 - command.words.name.size(), ' ') +
                command.words.summary + "\n";
    return text +
           "\n'scree COMMAND --help' shows a command's flags and an example, 'scree --version' "
           "the version.\n";
}

int complain(std::string_view name, std::string_view message, Status status) {
    print_error_line("scree " + std::string(name) + ": " + std::string(message));
    return status;
}

int run(const Command& command, std::vector<std::string> typed) {
    const std::string& name = command.words.name;
    try {
        Arguments arguments(command.words, std::move(typed));
        command.run(arguments);
        return kDone;
    } catch (const HelpRequest& help) {
        std::cout << help.what();
        return kDone;
    } catch (const Reported&) {
        return kFailed;
    } catch (const UsageError& error) {
        complain(name, error.what(), kWrongWords);
        print_error_line("'scree " + name +
                         " --help' shows how it is used, for example: " + command.words.example);
        return kWrongWords;
    } catch (const InvalidOption& error) {
        return complain(name, error.what(), kWrongWords);
    } catch (const Cancelled&) {
        return complain(name, "interrupted, nothing half-written is left", kInterrupted);
    } catch (const std::bad_alloc&) {
        return complain(name, "not enough memory; scale the picture down", kFailed);
    } catch (const std::exception& error) {
        return complain(name, error.what(), kFailed);
    }
}

int run_words(const std::vector<std::string>& words) {
    if (words.empty()) {
        std::cerr << overview();
        return kWrongWords;
    }
    if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
        std::cout << overview();
        return kDone;
    }
    if (words[0] == "--version") {
        std::cout << "scree " SCREE_VERSION "\n";
        return kDone;
    }
    for (const Command& command : commands())
        if (command.words.name == words[0])
            return run(command, {words.begin() + 1, words.end()});
    print_error_line("scree: there is no command '" + words[0] + "'; 'scree --help' lists them");
    return kWrongWords;
}

}  // namespace
}  // namespace scree::apps

int main(int n_words, char** words) {
    scree::apps::catch_stop_signals();
    const int status = scree::apps::run_words({words + 1, words + n_words});
    std::cout.flush();
    if (std::cout.good())
        return status;
    scree::apps::print_error_line("scree: cannot write to standard output");
    return status == 0 ? 1 : status;
}
