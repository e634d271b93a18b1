#include "terrain/contact/contact_force.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr double kLevel = 0.02;  // slope below which an underside counts as level
constexpr double kRim = 4.0;     // slope that stands for the end of an underside

bool fits(const FloatRaster* raster, const CellWindow& window) {
    return raster != nullptr && raster->width() == window.width &&
           raster->height() == window.height;
}

void check_ground(const GroundUnder& ground, Reading reading) {
    if (!fits(ground.heights, ground.window))
        fail<InvalidInput>("the heights under the contact do not fit its window of ",
                           ground.window.width, " x ", ground.window.height, " cells");
    if (reading == Reading::Literal && !fits(ground.mobility, ground.window))
        fail<InvalidInput>("the literal contact rule needs the mobility of every cell of its ",
                           ground.window.width, " x ", ground.window.height, " cells");
    if (!(ground.cell_size > 0.0) || !std::isfinite(ground.cell_size))
        fail<InvalidInput>("the cell size is ", ground.cell_size, " m, it must be positive");
}

void check_body(const PressingBody& body, std::size_t index) {
    if (body.underside == nullptr || !fits(&body.underside->heights, body.underside->window))
        fail<InvalidInput>("body ", index, " has no underside that fits its window");
    const bool finite = std::isfinite(body.force.x) && std::isfinite(body.force.y) &&
                        std::isfinite(body.force.z) && std::isfinite(body.centre.x) &&
                        std::isfinite(body.centre.y) && std::isfinite(body.mass);
    if (!finite || body.mass < 0.0)
        fail<InvalidInput>("body ", index, " has mass ", body.mass, " kg and force (", body.force.x,
                           ", ", body.force.y, ", ", body.force.z,
                           ") N: they must be finite, the mass not negative");
}

// Rise of the underside towards +X or +Z, a slope. Where it ends it rises; what lies beyond the
// raster is not known and says nothing.
double rise(const FloatRaster& heights, int x, int y, int dx, int dy, double cell_size) {
    const float here = heights(x, y);
    double sum = 0.0;
    int n_known = 0;
    for (const int side : {-1, 1}) {
        const int ox = x + side * dx;
        const int oy = y + side * dy;
        if (!heights.contains(ox, oy))
            continue;
        const float there = heights(ox, oy);
        sum += side * (there == kNone ? kRim : (static_cast<double>(there) - here) / cell_size);
        ++n_known;
    }
    return n_known > 0 ? sum / n_known : 0.0;
}

glm::dvec2 unit_or_zero(const glm::dvec2& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec2(0.0);
}

// One body over the cells of the ground's window.
class Press {
public:
    Press(const PressingBody& body, const GroundUnder& ground, const ContactOptions& options)
        : body_(body), ground_(ground), options_(options) {
        cells_ = intersection(body.underside->window, ground.window);
    }

    BodyContact add_to(Load& load) {
        measure();
        for_each_contact([&](int x, int y, double depth) {
            const glm::dvec2 force = options_.reading == Reading::Sound
                                         ? shared_force(x, y, depth)
                                         : literal_force(x, y, depth);
            const glm::dvec2 borne = yielded(force) / unit_newtons();
            load.force_x(x - ground_.window.x, y - ground_.window.y) += static_cast<float>(borne.x);
            load.force_z(x - ground_.window.x, y - ground_.window.y) += static_cast<float>(borne.y);
        });
        lower_underside(load);
        return contact_;
    }

private:
    // Calls with grid coordinates and the penetration, metres.
    template <class Visit>
    void for_each_contact(Visit&& visit) const {
        for (int y = cells_.y; y < cells_.y + cells_.height; ++y)
            for (int x = cells_.x; x < cells_.x + cells_.width; ++x) {
                const float under = under_at(x, y);
                const float height = (*ground_.heights)(x - ground_.window.x, y - ground_.window.y);
                const double depth = static_cast<double>(height) - under;
                if (under < kNone &&
                    (options_.reading == Reading::Literal ? depth >= 0.0 : depth > 0.0))
                    visit(x, y, depth);
            }
    }

    float under_at(int x, int y) const {
        const CellWindow& window = body_.underside->window;
        return body_.underside->heights(x - window.x, y - window.y);
    }

    void measure() {
        double sum = 0.0;
        for_each_contact([&](int, int, double depth) {
            ++contact_.cells;
            contact_.deepest_m = std::max(contact_.deepest_m, depth);
            sum += depth;
        });
        const double cell_area = ground_.cell_size * ground_.cell_size;
        contact_.area_m2 = cell_area * contact_.cells;
        contact_.overlap_m3 = cell_area * sum;
        contact_.smaller_than_cell = body_.underside->lost;
        per_depth_ = sum > 0.0 ? 1.0 / sum : 0.0;
    }

    // C.9: sigma * [(F_x, F_z) + kappa * (max(0, -F_y) + m g) * outward].
    glm::dvec2 shared_force(int x, int y, double depth) {
        const double share = depth * per_depth_;
        const double load =
            options_.spread * (std::max(0.0, -body_.force.y) + body_.mass * options_.gravity);
        const glm::dvec2 outwards = share * load * outward(x, y);
        const glm::dvec2 drag = share * glm::dvec2(body_.force.x, body_.force.z);
        contact_.drag_force += drag;
        contact_.outward_force += glm::length(outwards);
        return drag + outwards;
    }

    // F.4 as printed: F = p * mobility * F_obj, p rescaled to metres.
    glm::dvec2 literal_force(int x, int y, double depth) {
        const double mobility = (*ground_.mobility)(x - ground_.window.x, y - ground_.window.y);
        const glm::dvec2 drag = depth * mobility * glm::dvec2(body_.force.x, body_.force.z);
        contact_.drag_force += drag;
        return drag;
    }

    double unit_newtons() const {
        return options_.unit_stress * ground_.cell_size * ground_.cell_size;
    }

    glm::dvec2 yielded(const glm::dvec2& force) {
        const double most = options_.yield * unit_newtons();
        const double length = glm::length(force);
        if (options_.yield <= 0.0 || length <= most)
            return force;
        contact_.unspent_force += length - most;
        return force * (most / length);
    }

    glm::dvec2 outward(int x, int y) const {
        const double size = ground_.cell_size;
        if (options_.outward == Outward::Surface) {
            const FloatRaster& heights = body_.underside->heights;
            const int ux = x - body_.underside->window.x;
            const int uy = y - body_.underside->window.y;
            const glm::dvec2 slope(rise(heights, ux, uy, 1, 0, size),
                                   rise(heights, ux, uy, 0, 1, size));
            if (glm::length(slope) > kLevel)
                return unit_or_zero(slope);
        }
        return unit_or_zero(glm::dvec2((x + 0.5) * size, (y + 0.5) * size) - body_.centre);
    }

    void lower_underside(Load& load) const {
        for (int y = cells_.y; y < cells_.y + cells_.height; ++y)
            for (int x = cells_.x; x < cells_.x + cells_.width; ++x) {
                float& lowest = load.underside(x - ground_.window.x, y - ground_.window.y);
                lowest = std::min(lowest, under_at(x, y));
            }
    }

    const PressingBody& body_;
    const GroundUnder& ground_;
    const ContactOptions& options_;
    CellWindow cells_;
    BodyContact contact_;
    double per_depth_ = 0.0;
};

}  // namespace

CellWindow common_window(std::span<const PressingBody> bodies) {
    CellWindow all;
    for (const PressingBody& body : bodies) {
        const CellWindow one = body.underside == nullptr ? CellWindow{} : body.underside->window;
        if (one.empty())
            continue;
        if (all.empty()) {
            all = one;
            continue;
        }
        const int right = std::max(all.x + all.width, one.x + one.width);
        const int bottom = std::max(all.y + all.height, one.y + one.height);
        all.x = std::min(all.x, one.x);
        all.y = std::min(all.y, one.y);
        all.width = right - all.x;
        all.height = bottom - all.y;
    }
    return all;
}

ContactLoad contact_load(std::span<const PressingBody> bodies, const GroundUnder& ground,
                         const ContactOptions& options) {
    check(options);
    check_ground(ground, options.reading);
    const CellWindow& window = ground.window;
    ContactLoad out;
    out.load = {window, FloatRaster(window.width, window.height),
                FloatRaster(window.width, window.height),
                FloatRaster(window.width, window.height, kNone)};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        check_body(bodies[i], i);
        out.bodies.push_back(Press(bodies[i], ground, options).add_to(out.load));
    }
    return out;
}

}  // namespace scree::terrain
