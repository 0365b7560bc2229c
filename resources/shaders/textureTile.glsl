// Access to the tile of a quad, for samplers declared as `uniform samplerTile name;` and set by a
// <tileSampler sampler="name">. Where a quad has no tile of its own, the part of an ancestor's tile
// that covers the quad is used. (terrain reference 2.3)

struct samplerTile {
    sampler2DArray tilePool; // the tiles, one a layer
    vec3 tileCoords;         // of the quad's lower left corner in the pool: u, v, layer
    vec3 tileSize;           // of the quad in the pool: du, dv; and in texels of a whole tile
};

// How much of the tile the quad is, along an edge: 1 of its own tile, 1/2 of its parent's, and so on.
// An ancestor's tile is the finest that is known of a place: shaders that blend the levels show its
// own level, whatever the quad's.
float tilePart(samplerTile tex) {
    float texels = tex.tileSize.x * float(textureSize(tex.tilePool, 0).x);
    return 1.0 / round(tex.tileSize.z / texels);
}

// The value at uv in [0,1]^2 of the quad.
vec4 textureTile(samplerTile tex, vec2 uv) {
    vec3 uvl = tex.tileCoords + vec3(uv * tex.tileSize.xy, 0.0);
    return texture(tex.tilePool, uvl);
}

// The same, interpolated between the four nearest texels even if the pool's filter is NEAREST.
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
