// What every pass knows of the frame. Mirrors `FrameUniforms` in server/render/frame_uniforms.h; a test compares them.
layout(std140, binding = 0) uniform FrameUniforms {
  vec4 eye;                // m
  vec4 rightAndSlope;      // axis x of view space; largest |W_x|
  vec4 downAndSlope;       // axis y; largest |W_y|
  vec4 forwardAndPixel;    // axis z; pixel slope C
  vec4 pictureSize;        // width, height; 1/width, 1/height
  vec4 floorAndHaze;       // height, m; tile, m; 1 with a floor, else 0; haze distance, m
  vec4 tileLight;
  vec4 tileDark;
  vec4 ambientRed;         // ambient light, see ambientLight(): factors of n and 1,
  vec4 ambientGreen;
  vec4 ambientBlue;
  vec4 ambientRed2;        // of xy, yz, zz and zx,
  vec4 ambientGreen2;
  vec4 ambientBlue2;
  vec4 ambientPlane;       // and of xx − yy, for red, green and blue
  vec4 floorLight;         // on the floor, as radiance of something white there; the sun's share of its luminance
  vec4 backdrop;           // its colour; 1 where there is one, else 0
  vec4 sun;                // unit vector towards the sun; 1 where its disc is seen, else 0
  vec4 sunlight;           // radiance of a white surface that faces the sun
  vec4 lightCorner;        // where the light map's first cell falls on the floor, m; strength of shadows
  vec4 lightRight;         // from there along the map's rows to their end, m
  vec4 lightDown;          // along its columns
  vec4 pictureSlopes;      // largest |W_x|, |W_y| of the picture
} frame;

vec3 toView(vec3 world) {
  vec3 p = world - frame.eye.xyz;
  return vec3(dot(p, frame.rightAndSlope.xyz), dot(p, frame.downAndSlope.xyz), dot(p, frame.forwardAndPixel.xyz));
}

vec3 toWorldDirection(vec3 view) {
  return view.x * frame.rightAndSlope.xyz + view.y * frame.downAndSlope.xyz + view.z * frame.forwardAndPixel.xyz;
}
