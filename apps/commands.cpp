#include "apps/commands.h"

#include <vector>

namespace scree::apps {

std::span<const Command> commands() {
    static const std::vector<Command> table = {
        {{"rocks", "find the rocks of photographs; write outlines, meshes, maps and figures",
          "scree rocks gravel.jpg -o out --width-m 0.8",
          "One photograph: the files lie in DIR. Several: one folder each, named after the "
          "photograph; a bad one does not stop the others and the exit status is 1. Without "
          "--width-m the scale is taken from the photograph's metadata; where that has none, a "
          "pixel counts as a millimetre and sizes are given in pixels."},
         run_rocks},
        {{"mesh", "build the meshes and maps again from a file of rocks, perhaps edited",
          "scree mesh out/rocks.json -o out2 --photo gravel.jpg", ""},
         run_mesh},
        {{"scatter", "cover ground with copies of a photograph's rocks; the patch tiles",
          "scree scatter out/rocks.json -o patch.glb --photo gravel.jpg --size-m 2 --count 3000",
          ""},
         run_scatter},
        {{"procedural", "make rocks from spherical noise, without a photograph",
          "scree procedural -o rock.glb --seed 7 --count 9 --picture rocks.png", ""},
         run_procedural},
        {{"describe",
          "say what the ground is made of, place by place, from pictures, rules or strokes",
          "scree describe --labels out/labels.png --photo gravel.jpg --width-m 0.8 -o ground",
          "Writes materials.json, ids.png, description.png to look at and, where cells differ from "
          "their materials, params.exr; with --layers also layers.exr, what every layer holds. On "
          "request: the published set of map_rgba.png, "
          "map_ids.txt, "
          "ground.frag.glsl and ground.tese.glsl; ground_albedo.png, ground_normal.png and "
          "ground_height.exr; channel_*.png. Says what a form could not keep. "
          "docs/description-maps.md describes the files."},
         run_describe},
        {{"deform", "press, roll and drag objects over ground that gives way",
          "scree deform testdata/scenes/sand.json -o out",
          "Writes ddh.exr (displacements) and height.exr in metres, terrain.glb, frames, "
          "preview.gif, settled.png where the scene asks for it, and report.json: all of them, or "
          "none if it is stopped."},
         run_deform},
        {{"weather", "wear a mesh as wind and frost do: protrusions recede, hollows stay",
          "scree weather statue.ply -o worn.ply --steps 50 --power 2 --before-after worn.png",
          "With --checkpoint a run that was stopped goes on where it was, to the same bytes; the "
          "file goes when the run is done. A mesh that tangles goes back to its last clean state "
          "and takes shorter steps."},
         run_weather},
        {{"erode", "let water wear a mesh: fluid, erosion, meshes and pictures of both",
          "scree erode testdata/scenes/erode_canyon.json -o out",
          "The scene is described in docs/hydraulic-erosion.md. Frames and checkpoints appear one "
          "by "
          "one, each whole, all else at the end."},
         run_erode},
        {{"terrain", "make a mesh of ground from a height map or survey points; cut river beds in",
          "scree terrain heights.exr -o river.ply --vertices 20000 --bed bed.json",
          "Reads a height map (EXR in metres, PNG) or the points of a PLY or LAS file. Points are "
          "thinned, triangulated and moved so that the least x and z are 0; lines of beds are "
          "given in the file's own coordinates. The mesh is an open sheet that scree erode and "
          "scree weather take. docs/terrain-preparation.md describes the file of beds."},
         run_terrain},
        {{"render", "draw a ground: textured, as wires, by height or by material",
          "scree render heights.exr -o ground.png --map ground --view textured",
          "Needs OpenGL 4.5 but no display and no graphics card: Mesa draws on the processor where "
          "there is none (packages libegl1, libegl-mesa0, libgl1-mesa-dri). docs/terrain-view.md "
          "says how it draws."},
         run_render},
        {{"score", "compare label maps with hand-made ones", "scree score out/labels.png truth.png",
          "Several pairs give a line each and their mean. Label maps have one channel of 8 or 16 "
          "bits; 0 is background and every other value one rock."},
         run_score},
        {{"check", "look for errors in binary glTF files, instances included",
          "scree check out/rocks.glb out/patch.glb",
          "Looks where other validators do not: at EXT_mesh_gpu_instancing, bounds, indices and "
          "the tree of nodes. The exit status is 1 if there is an error."},
         run_check},
        {{"classify", "cut a photograph of ground into sand, mud, pebbles, rock and grass",
          "scree classify ground.jpg -o out --width-m 3",
          "Without --width-m the scale is taken from the photograph's metadata; where that has "
          "none, a pixel counts as a millimetre. With --heights, ground steeper than a class can "
          "lie speaks against it."},
         run_classify},
    };
    return table;
}

}  // namespace scree::apps
