#include "terrain/gpu/soil_palette.h"

#include <map>

namespace scree::terrain {

SoilPalette soil_palette(const SoilField& soil, int width, int height, bool angles) {
    SoilPalette palette;
    palette.index = Raster<std::uint8_t>(width, height);
    std::map<SoilRecord, std::uint8_t> places;
    SoilTile tile;
    for (int y = 0; y < height; ++y) {
        soil.fill({0, y, width, 1}, tile);
        for (int x = 0; x < width; ++x) {
            const SoilRecord record{angles ? tile.repose(x, 0) : tile.tan_repose(x, 0),
                                    tile.diffusion(x, 0), tile.mobility(x, 0),
                                    tile.compaction(x, 0)};
            if (palette.fits) {
                auto found = places.find(record);
                if (found == places.end() && places.size() < 256) {
                    found = places.emplace(record, static_cast<std::uint8_t>(places.size())).first;
                    palette.table.push_back(record);
                }
                palette.fits = found != places.end();
                if (palette.fits)
                    palette.index(x, y) = found->second;
                else {  // begin again, cell by cell
                    palette.cells = Raster<SoilRecord>(width, height);
                    y = -1;
                    break;
                }
            } else {
                palette.cells(x, y) = record;
            }
        }
    }
    return palette;
}

}  // namespace scree::terrain
