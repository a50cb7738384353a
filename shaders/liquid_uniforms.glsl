// What passes know of the liquid at hand. Mirrors `LiquidUniforms` in server/render/liquid_uniforms.h; a test compares
// them.
layout(std140, binding = 1) uniform LiquidUniforms {
  vec4 splat;              // radius R, m; radius of a drop of spray, m; spacing d, m; depth of flat rims, R, or 0
  vec4 slopes;             // largest |W_x|, |W_y| of the thickness; of the surface
  vec4 nearDepth;          // depth before which surfaces are cut, m
  vec4 absorptionAndIndex; // 1/m; refractive index n
  vec4 scatterAndShift;    // light that a deep layer sends back; γ of the screen shift, heights of the picture per m
  vec4 colourAndDiffuse;   // diffuse colour; share of Phong's diffuse part
  vec4 gloss;              // roughness α, or Phong's exponent; strength of the highlight
  vec4 emission;           // radiance
  vec4 reflectance;        // of a metal at right angles
  vec4 cubeAndReach;       // where the cube map was taken, m; how far bodies reach behind what is seen of them, m
  vec4 mirrorSteps;        // places along a mirrored ray that are looked at
  vec4 sprayTint;          // what spray makes of white; 1 where it glows as the liquid does, else 0
} liquid;
