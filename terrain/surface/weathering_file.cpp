#include "terrain/surface/weathering_file.h"

#include "base/error.h"

#include <cmath>
#include <cstring>

namespace scree::terrain {
namespace {

constexpr std::string_view kMark = "scree weathering 1\n";

// FNV-1a.
class Hash {
public:
    template <class T>
    void add(const T& value) {
        add_bytes(&value, sizeof value);
    }
    void add_bytes(const void* data, std::size_t n) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < n; ++i)
            value_ = (value_ ^ bytes[i]) * 0x100000001b3ULL;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

template <class T>
void put(std::string& out, const T& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
void put_array(std::string& out, const std::vector<T>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    if (!values.empty())
        out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

class Reader {
public:
    Reader(std::span<const std::uint8_t> bytes, std::string_view name)
        : bytes_(bytes), name_(name) {}

    void take_bytes(void* out, std::size_t n) {
        if (n > bytes_.size())
            fail<InvalidInput>("cannot resume from ", name_, ": it ends too soon");
        if (n > 0)
            std::memcpy(out, bytes_.data(), n);
        bytes_ = bytes_.subspan(n);
    }
    template <class T>
    void take(T& value) {
        take_bytes(&value, sizeof value);
    }
    template <class T>
    void take_array(std::vector<T>& values) {
        std::uint64_t n = 0;
        take(n);
        if (n > bytes_.size() / sizeof(T))
            fail<InvalidInput>("cannot resume from ", name_, ": it ends too soon");
        values.resize(n);
        take_bytes(values.data(), n * sizeof(T));
    }
    std::size_t left() const { return bytes_.size(); }

private:
    std::span<const std::uint8_t> bytes_;
    std::string_view name_;
};

// Every number of a state but its mesh, for both directions.
template <class State, class Visitor>
void visit(State& state, Visitor&& field) {
    field(state.steps);
    field(state.dose);
    field(state.dose_wanted);
    field(state.step_limit);
    field(state.start_edge);
    field(state.restarts);
    field(state.n_collapsed);
    field(state.n_at_start);
    field(state.frozen_factor);
}

bool makes_sense(const WeatheringState& s) {
    const bool finite = std::isfinite(s.dose) && std::isfinite(s.dose_wanted) &&
                        std::isfinite(s.step_limit) && std::isfinite(s.start_edge) &&
                        std::isfinite(s.frozen_factor);
    return finite && s.dose >= 0.0 && s.step_limit > 0.0 && s.steps >= 0 && s.restarts >= 0 &&
           s.n_collapsed >= 0 && s.n_at_start >= 0;
}

}  // namespace

std::uint64_t run_key(const meshing::TriMesh& mesh, const WeatheringOptions& options) {
    Hash hash;
    hash.add_bytes(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    hash.add_bytes(mesh.texcoords.data(), mesh.texcoords.size() * sizeof(glm::vec2));
    hash.add_bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    WeatheringOptions copy = options;
    describe(copy, [&](std::string_view name, const auto& value, const FieldInfo&) {
        hash.add_bytes(name.data(), name.size());
        hash.add(static_cast<double>(value));
    });
    return hash.value();
}

std::string encode_state(const WeatheringState& state, std::uint64_t key) {
    std::string out(kMark);
    put(out, key);
    visit(state, [&](const auto& value) { put(out, value); });
    put_array(out, state.mesh.positions);
    put_array(out, state.mesh.texcoords);
    put_array(out, state.mesh.triangles);
    Hash hash;
    hash.add_bytes(out.data(), out.size());
    put(out, hash.value());
    return out;
}

WeatheringState decode_state(std::span<const std::uint8_t> bytes, std::uint64_t key,
                             std::string_view name) {
    Reader reader(bytes, name);
    std::string mark(kMark.size(), ' ');
    std::uint64_t found = 0;
    if (bytes.size() < kMark.size() || std::memcmp(bytes.data(), kMark.data(), kMark.size()) != 0)
        fail<InvalidInput>("cannot resume from ", name, ": it is no checkpoint of scree weather");
    reader.take_bytes(mark.data(), mark.size());
    reader.take(found);
    if (found != key)
        fail<InvalidInput>("cannot resume from ", name,
                           ": it belongs to another mesh or other options; remove it to start "
                           "from the beginning");
    WeatheringState state;
    visit(state, [&](auto& value) { reader.take(value); });
    reader.take_array(state.mesh.positions);
    reader.take_array(state.mesh.texcoords);
    reader.take_array(state.mesh.triangles);
    Hash hash;
    std::uint64_t sum = 0;
    if (reader.left() == sizeof sum)
        hash.add_bytes(bytes.data(), bytes.size() - sizeof sum);
    reader.take(sum);
    if (reader.left() != 0 || sum != hash.value() || !makes_sense(state))
        fail<InvalidInput>("cannot resume from ", name, ": it is damaged");
    meshing::check_mesh(state.mesh);
    return state;
}

}  // namespace scree::terrain
