#pragma once

#include "terrain/grid/deformer.h"
#include "terrain/grid/sound_step.h"
#include "terrain/grid/tile_patch.h"
#include "terrain/grid/tile_store.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace scree::terrain {

/// The sound scheme on tiles: what changed in one iteration bounds what can change in the next, so
/// only tiles within reach of a change or a load are stepped, several iterations at a time.
class SoundGround {
public:
    SoundGround(const Heightfield& base, const SoilField& soil, const DeformerOptions& options);

    /// One frame.
    /// @param moved  If given: upper bound of what a cell moved in the frame, metres.
    DeformerReport step(std::span<const Load> loads, float* moved = nullptr);

    /// New displacements for the whole ground; every tile that they change is restless.
    void replace(FloatRaster displacement);

    const TileStore& store() const { return store_; }
    std::size_t bytes() const;

private:
    struct Work {
        int tile = 0;
        CellWindow region;   ///< Cells of the tile that may change.
        FloatBlock block;    ///< New values; null if nothing changed.
        CellWindow changed;  ///< Cells that the last iteration changed.
        double compacted = 0.0;
        float moved = 0.0F;
    };
    struct Pass {
        std::span<const Load> loads;
        int iterations = 1;
        bool measure = false;
    };

    void schedule(const Pass& pass, bool first);
    void reach(const CellWindow& source, int distance);
    void run(const Pass& pass, Work& work);
    bool is_direct(const Pass& pass, int tile) const;
    void step_direct(const Work& work, float* out, PatchChange& change);
    void step_patched(const Pass& pass, const Work& work, float* out, PatchChange& change);
    void finish(Work& work, const PatchChange& change, FloatBlock block, bool measure);
    void commit(DeformerReport& report, float* moved);
    const SoilPatch& soil_of(int tile);
    void drop_idle_soil();
    std::unique_ptr<PatchScratch> take_scratch();
    void give_scratch(std::unique_ptr<PatchScratch> scratch);

    const Heightfield* base_;
    SoilField soil_;
    int iterations_;
    SoundRule rule_;
    TileStore store_;
    std::vector<std::pair<int, CellWindow>> restless_;  ///< Tiles with the cells that changed last.
    std::vector<CellWindow> last_windows_;              ///< Of the last frame's loads.
    bool fresh_ = true;                                 ///< No frame was stepped yet.
    std::vector<Work> work_;                            ///< Of this pass, by tile.
    std::vector<int> work_of_tile_;                     ///< 1 + index into work_, 0 for none.
    std::vector<std::uint32_t> stepped_in_;             ///< Frame in which a tile was stepped last.
    std::vector<int> stepped_, stepped_before_;         ///< Tiles of this and the last frame.
    std::uint32_t frame_ = 0;
    std::vector<std::unique_ptr<SoilPatch>> soil_patches_;  ///< One, or one for each tile.
    std::vector<std::unique_ptr<PatchScratch>> scratch_;
    std::size_t n_scratch_ = 0;
    mutable std::mutex guard_;
};

}  // namespace scree::terrain
