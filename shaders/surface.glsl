// The liquid's front as inverse depth q = 1/z over the picture.
layout(binding = 0) uniform sampler2D surface;

float inverseDepthAt(vec2 at) { return texture(surface, at).r; }

// Whether two neighbouring pixels lie on one surface: their eye depths differ by at most `edge`. As
// z_a − z_b = (q_b − q_a)/(q_a·q_b), this needs no division, and fails by itself where one is 0: no liquid.
bool onOneSurface(float qa, float qb, float edge) { return abs(qb - qa) <= edge * qa * qb; }
