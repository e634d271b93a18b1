#include "terrain/surface/erosion_checkpoint.h"

#include "base/error.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace scree::terrain {
namespace {

constexpr std::uint64_t kMagic = 0x31305252'45435253ULL;  // SRCERR01 in the file

// FNV-1a: enough to tell scenes and damaged files apart.
std::uint64_t digest(std::span<const std::uint8_t> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const std::uint8_t byte : bytes)
        hash = (hash ^ byte) * 0x100000001b3ULL;
    return hash;
}

std::uint64_t digest(std::string_view text) {
    return digest(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

// Every value of a run in one order, for the writer and the reader alike.
template <class Run, class Visit>
void visit_run(Run& run, Visit&& visit) {
    visit(run.mesh.positions);
    visit(run.mesh.triangles);
    visit(run.fluid.positions);
    visit(run.fluid.velocities);
    visit(run.fluid.ids);
    visit(run.fluid.contacts);
    visit(run.fluid.radius);
    visit(run.fluid.contact_distance);
    visit(run.fluid.seconds);
    visit(run.fluid.next_id);
    visit(run.fluid.tally);
    visit(run.sediment.carried);
    visit(run.sediment.ids);
    visit(run.sediment.pending);
    visit(run.sediment.lost);
    visit(run.sediment.eroded);
    visit(run.sediment.deposited);
    visit(run.step_limit);
    visit(run.dose);
    visit(run.warmed_up);
    auto& r = run.report;
    visit(r.steps);
    visit(r.restarts);
    visit(r.step_limit);
    visit(r.intersections_before);
    visit(r.intersections);
    visit(r.volume_before);
    visit(r.volume);
    visit(r.mean_particles);
    visit(r.mean_touching);
    visit(r.mean_affected);
    visit(r.n_collapsed);
    visit(r.times);
}

struct Writer {
    std::vector<std::uint8_t>& bytes;

    void raw(const void* data, std::size_t size) {
        const std::size_t at = bytes.size();
        bytes.resize(at + size);
        std::memcpy(bytes.data() + at, data, size);
    }
    template <class Value>
    void operator()(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        raw(&value, sizeof value);
    }
    template <class Value>
    void operator()(const std::vector<Value>& values) {
        (*this)(static_cast<std::uint64_t>(values.size()));
        if (!values.empty())
            raw(values.data(), values.size() * sizeof(Value));
    }
};

struct Reader {
    std::span<const std::uint8_t> bytes;
    const std::string& source;

    void raw(void* data, std::size_t size) {
        if (size > bytes.size())
            fail<InvalidInput>(source, " is a damaged checkpoint: it ends too early");
        if (size > 0)
            std::memcpy(data, bytes.data(), size);
        bytes = bytes.subspan(size);
    }
    template <class Value>
    void operator()(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        raw(&value, sizeof value);
    }
    template <class Value>
    void operator()(std::vector<Value>& values) {
        std::uint64_t n = 0;
        (*this)(n);
        if (n > bytes.size() / sizeof(Value))
            fail<InvalidInput>(source, " is a damaged checkpoint: a list is longer than the file");
        values.resize(static_cast<std::size_t>(n));
        raw(values.data(), values.size() * sizeof(Value));
    }
};

void check_run(const ErosionRun& run, const std::string& source) {
    try {
        meshing::check_mesh(run.mesh);
        check_fluid_state(run.fluid);
    } catch (const InvalidInput& error) {
        fail<InvalidInput>(source, " is a damaged checkpoint: ", error.what());
    }
    const bool sound = run.sediment.carried.size() == run.sediment.ids.size() &&
                       (run.sediment.pending.empty() ||
                        run.sediment.pending.size() == run.mesh.positions.size()) &&
                       run.step_limit >= 1.0 && run.dose >= 0.0 && run.warmed_up >= 0 &&
                       run.report.steps >= 0;
    if (!sound)
        fail<InvalidInput>(source, " is a damaged checkpoint: its numbers contradict each other");
}

}  // namespace

std::vector<std::uint8_t> encode_checkpoint(const ErosionRun& run, std::string_view scene) {
    static_assert(std::endian::native == std::endian::little);
    std::vector<std::uint8_t> bytes;
    Writer writer{bytes};
    writer(kMagic);
    writer(digest(scene));
    visit_run(run, writer);
    writer(digest(std::span<const std::uint8_t>(bytes)));
    return bytes;
}

ErosionRun decode_checkpoint(std::span<const std::uint8_t> bytes, std::string_view scene,
                             const std::string& source) {
    Reader reader{bytes, source};
    std::uint64_t magic = 0;
    std::uint64_t of_scene = 0;
    if (bytes.size() < 3 * sizeof magic)
        fail<InvalidInput>(source, " is no checkpoint of an erosion run");
    reader(magic);
    if (magic != kMagic)
        fail<InvalidInput>(source, " is no checkpoint of an erosion run");
    reader(of_scene);
    if (of_scene != digest(scene))
        fail<InvalidInput>(source,
                           " belongs to another scene, or to this one before it was edited; "
                           "start afresh without it");
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    if (stored != digest(bytes.first(bytes.size() - sizeof stored)))
        fail<InvalidInput>(source, " is a damaged checkpoint; start afresh without it");
    ErosionRun run;
    visit_run(run, reader);
    if (reader.bytes.size() != sizeof stored)
        fail<InvalidInput>(source, " is a damaged checkpoint: it is longer than its run");
    check_run(run, source);
    return run;
}

}  // namespace scree::terrain
