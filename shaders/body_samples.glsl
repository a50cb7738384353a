// The bodies, four samples a pixel: light, and depth as bodies.vert stores it.
layout(binding = 5) uniform sampler2DMS bodyLight;
layout(binding = 6) uniform sampler2DMS bodyDepth;

const int samples = 4;

// Inverse eye depth of one sample; 0 where there is no body.
float sampleDepth(int i) { return texelFetch(bodyDepth, ivec2(gl_FragCoord.xy), i).r * 100.0; }
vec4 sampleLight(int i) { return texelFetch(bodyLight, ivec2(gl_FragCoord.xy), i); }
