// Access to the tiles of a whole terrain at any point, through the tile map of a
// <gpuTileStorage tileMap="true">: shadows of clouds on the ground, for example. Instead of
// textureTile.glsl, whose samplerTile it extends; its functions are here too.
// (terrain reference 2.3, 3.6)

struct samplerTile {
    sampler2DArray tilePool; // the tiles, one a layer
    vec3 tileCoords;         // of the quad's lower left corner in the pool: u, v, layer
    vec3 tileSize;           // of the quad in the pool: du, dv; and in texels of a whole tile
    sampler2D tileMap;       // which layer holds which quad; a row for each producer
    vec4 quadInfo;           // edge of the root quad, split distance s, 2k, 4k+2, with k = ceil(s)
    vec4 poolInfo;           // edge of a tile and of its border in texels, 1/width, 1/height
    vec4 camera[6];          // for each terrain: camera relative to the root's corner, height over
                             // the ground, deepest level
};

vec4 textureTile(samplerTile tex, vec2 uv) {
    vec3 uvl = tex.tileCoords + vec3(uv * tex.tileSize.xy, 0.0);
    return texture(tex.tilePool, uvl);
}

vec4 textureTileLinear(samplerTile tex, vec2 uv) {
    vec2 st = uv * tex.tileSize.z;
    vec2 f = fract(st);
    vec2 p = floor(st);
    vec4 c00 = textureTile(tex, p / tex.tileSize.z);
    vec4 c10 = textureTile(tex, (p + vec2(1.0, 0.0)) / tex.tileSize.z);
    vec4 c01 = textureTile(tex, (p + vec2(0.0, 1.0)) / tex.tileSize.z);
    vec4 c11 = textureTile(tex, (p + vec2(1.0, 1.0)) / tex.tileSize.z);
    return mix(mix(c00, c10, f.x), mix(c01, c11, f.x), f.y);
}

// Level of the leaf of the quadtree at p, in metres from the root's lower left corner: quads are
// split when the camera is nearer than s times their size.
float quadtreeLevel(samplerTile tex, vec2 p, vec4 camera) {
    float rootSize = tex.quadInfo.x;
    float s = tex.quadInfo.y;
    vec3 d = abs(vec3(p, 0.0) - camera.xyz);
    vec3 guess = 1.0 + floor(-log2(max(d, 1e-6) / (s * rootSize)));
    float level = max(min(min(guess.x, guess.y), min(guess.z, camera.w)), 0.0);
    // The guess is for the point; the quad around it may be nearer.
    float size = rootSize / exp2(level);
    vec2 low = floor(p / size) * size;
    vec2 toSides = min(abs(low - camera.xy), abs(low + size - camera.xy));
    float distance = max(camera.z, max(toSides.x, toSides.y));
    return level < camera.w && distance < s * size ? level + 1.0 : level;
}

// Texel of the map for a tile.
float tileMapIndex(samplerTile tex, float level, vec2 tile, float size, vec4 camera) {
    if (tex.quadInfo.z > 4.0) { // hashed; in integers, which are exact
        uint perRow = 1u << uint(level);
        uint id = uint(tile.x) + uint(tile.y) * perRow + (perRow * perRow - 1u) / 3u;
        return float(id % 4093u);
    }
    float k = tex.quadInfo.w; // quads along an edge of the part of a level around the camera
    vec2 first = 2.0 * floor(camera.xy / (2.0 * size)) - tex.quadInfo.z;
    vec2 t = tile - first;
    return (level * k + t.y) * k + t.x;
}

// The value at p, in metres from the centre of a terrain; 0 where there is no tile. `producerId`
// is the number of the producer in its cache, and of the terrain in the sampler's list.
vec4 textureQuadtree(samplerTile tex, vec2 p, int producerId) {
    vec4 camera = tex.camera[producerId];
    p += tex.quadInfo.x / 2.0;
    if (any(lessThan(p, vec2(0.0))) || any(greaterThanEqual(p, tex.quadInfo.xx))) return vec4(0.0);
    float level = quadtreeLevel(tex, p, camera);
    float size = tex.quadInfo.x / exp2(level);
    vec2 tile = floor(p / size);
    vec2 uv = fract(p / size);
    float index = tileMapIndex(tex, level, tile, size, camera);
    vec2 texel = vec2(index + 0.5, float(producerId) + 0.5) / vec2(4096.0, 8.0);
    vec2 entry = floor(255.0 * textureLod(tex.tileMap, texel, 0.0).rg + 0.5);
    if (entry.y == 0.0) return vec4(0.0);
    float layer = entry.x + 256.0 * (entry.y - 1.0);
    float border = tex.poolInfo.y;
    vec2 st = (border + uv * (tex.poolInfo.x - 2.0 * border)) * tex.poolInfo.zw;
    return textureLod(tex.tilePool, vec3(st, layer), 0.0);
}
