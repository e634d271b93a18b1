#pragma once

#include <sstream>
#include <stdexcept>

namespace scree {

/// Root of every exception this library throws. The message is one sentence for a
/// person: what failed, on which file or value, and what would be accepted.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A parameter is out of range.
class InvalidOption : public Error {
    using Error::Error;
};

/// The data breaks a precondition.
class InvalidInput : public Error {
    using Error::Error;
};

/// A file cannot be read or written.
class IoError : public Error {
    using Error::Error;
};

/// The caller asked for the work to stop.
class Cancelled : public Error {
    using Error::Error;
};

/// Throw E with a message made of the streamed parts.
template <class E, class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    throw E(text.str());
}

}  // namespace scree
