// Draws glyphs in front of everything. The program `text;` of showInfo and showLog: an archive may
// have a module `text` of its own, with the same attributes and sampler.
#ifdef _VERTEX_
layout(location = 0) in vec4 vertex; // x, y in clip space; u, v in the font's texture
layout(location = 1) in vec4 colour;
out vec2 glyphUv;
out vec4 glyphColour;
void main() {
    glyphUv = vertex.zw;
    glyphColour = colour;
    gl_Position = vec4(vertex.xy, -1.0, 1.0);
}
#endif

#ifdef _FRAGMENT_
uniform sampler2D font;
in vec2 glyphUv;
in vec4 glyphColour;
layout(location = 0) out vec4 data;
void main() {
    data = vec4(glyphColour.rgb, glyphColour.a * texture(font, glyphUv).r);
}
#endif
