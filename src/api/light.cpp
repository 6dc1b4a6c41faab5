#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/placement.h"
#include "light/photometry.h"
#include "light/portal.h"

#include <Imath/ImathVec.h>

#include <numbers>

using namespace bdpt;

namespace {

float cos_degrees(double angle) { return static_cast<float>(std::cos(angle * std::numbers::pi / 180)); }

Vec3 read_direction(const Subject& subject, const bdpt_light_desc& desc) {
  const Imath::V3d direction(desc.direction[0], desc.direction[1], desc.direction[2]);
  if (direction.length() == 0)
    subject.refuse("direction", "has length zero: give the way that light goes, of any length");
  return Vec3(direction / direction.length());
}

void check_ascending(const Subject& subject, const char* field, const float* angles, uint32_t count, float most) {
  for (uint32_t i = 0; i < count; ++i)
    if (!(angles[i] >= 0 && angles[i] <= most) || (i > 0 && !(angles[i] > angles[i - 1])))
      subject.refuse(field, "has the value ", angles[i], " at ", i, ": give ascending angles from 0 to ", most,
                     " degrees");
}

void read_photometry(const Subject& subject, const bdpt_light_desc& desc, LightDesc& light) {
  constexpr uint32_t kMaxAngles = 4096;
  const bdpt_photometry p = read_struct(desc.photometry, "desc.photometry");
  const Subject part("photometry", subject.label().c_str());
  part.check_range("vertical_count", p.vertical_count, 2, kMaxAngles);
  part.check_range("horizontal_count", p.horizontal_count, 1, kMaxAngles);
  part.check_reserved("reserved", p.reserved);
  for (const auto& [field, pointer] :
       {std::pair("vertical_angles", p.vertical_angles), std::pair("horizontal_angles", p.horizontal_angles),
        std::pair("intensities", p.intensities)})
    if (!pointer) part.refuse(field, "is NULL: pass the table");
  check_ascending(part, "vertical_angles", p.vertical_angles, p.vertical_count, 180);
  check_ascending(part, "horizontal_angles", p.horizontal_angles, p.horizontal_count, 360);
  const float last = p.horizontal_angles[p.horizontal_count - 1];
  if (p.horizontal_angles[0] != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
    part.refuse("horizontal_angles", "go from ", p.horizontal_angles[0], " to ", last,
                ": give 0 alone, or angles from 0 to 90, to 180 or to 360 degrees");
  const uint32_t count = p.vertical_count * p.horizontal_count;
  auto measured = std::make_shared<Photometry>();
  measured->vertical.assign(p.vertical_angles, p.vertical_angles + p.vertical_count);
  measured->horizontal.assign(p.horizontal_angles, p.horizontal_angles + p.horizontal_count);
  measured->intensities.assign(p.intensities, p.intensities + count);
  for (float v : measured->intensities)
    if (!(v >= 0) || !std::isfinite(v * norm(to_rgb(desc.intensity))))
      part.refuse("intensities", "has the value ", v, ": give finite values of at least 0");
  light.photometry = measured;
  light.direction = read_direction(subject, desc);
  light.up = to_vec3(desc.up);
}

void read_spot(const Subject& subject, const bdpt_light_desc& desc, const TextureEntry* texture, LightDesc& light) {
  light.direction = read_direction(subject, desc);
  if (!(desc.cone_angle > 0 && desc.cone_angle < 180))
    subject.refuse("cone_angle", "is ", desc.cone_angle, ": give an angle above 0 and below 180 degrees");
  if (!(desc.cone_falloff >= 0 && desc.cone_falloff <= desc.cone_angle))
    subject.refuse("cone_falloff", "is ", desc.cone_falloff, ": give a value from 0 to cone_angle (", desc.cone_angle,
                   ")");
  if (texture && !(desc.cone_angle <= 85))
    subject.refuse("cone_angle", "is ", desc.cone_angle, ": a spot with a texture has at most 85 degrees");
  if (texture && !std::isfinite(norm(light.intensity) * texture->maximum))
    subject.refuse("intensity", "times texels up to ", texture->maximum, " is no finite number: give less");
  light.up = to_vec3(desc.up);
  light.cos_outer = cos_degrees(desc.cone_angle);
  light.cos_inner = cos_degrees(double(desc.cone_angle) - double(desc.cone_falloff));
}

void read_directional(const Subject& subject, const bdpt_light_desc& desc, LightDesc& light) {
  light.direction = read_direction(subject, desc);
  if (!(desc.angular_radius >= 0 && desc.angular_radius <= 80))
    subject.refuse("angular_radius", "is ", desc.angular_radius,
                   ": give the radius of the disc in degrees, from 0 to 80");
  light.irradiance = to_rgb(desc.irradiance);
  light.angular_radius = double(desc.angular_radius) * std::numbers::pi / 180;
}

void read_environment(const Subject& subject, const bdpt_light_desc& desc, const TextureEntry* texture,
                      LightDesc& light) {
  light.radiance = to_rgb(desc.radiance);
  light.transform = read_transform(subject, desc.transform);
  if (uniform_scale(light.transform) == 0)
    subject.refuse("transform", "is no rotation: give axes of equal length at right angles, or twelve zeros");
  light.transform = without_scale(light.transform);
  if (texture && !std::isfinite(norm(light.radiance) * texture->maximum))
    subject.refuse("radiance", "times texels up to ", texture->maximum, " is no finite number: give less");
}

void read_portals(const Subject& subject, const bdpt_light_desc& desc, LightDesc& light) {
  constexpr float kMaxCosine = 1e-3f;  // that edges at right angles may have
  if (desc.portal_count == 0) return;
  if (light.has_position())
    subject.refuse("portal_count", "is ", desc.portal_count,
                   ": only environments and directional lights come through portals; set it to 0");
  subject.check_range("portal_count", desc.portal_count, 0, uint32_t(Portals::kMost));
  if (!desc.portals) subject.refuse("portals", "is NULL, but portal_count is ", desc.portal_count, ": pass the array");
  for (uint32_t i = 0; i < desc.portal_count; ++i) {
    const bdpt_portal& p = desc.portals[i];
    for (const auto& [field, value] :
         {std::pair("corner", p.corner), std::pair("edge_u", p.edge_u), std::pair("edge_v", p.edge_v)})
      subject.check_finite(("portals[" + std::to_string(i) + "]." + field).c_str(), value, 3);
    const Imath::V3d u(p.edge_u[0], p.edge_u[1], p.edge_u[2]), v(p.edge_v[0], p.edge_v[1], p.edge_v[2]);
    if (u.length() == 0 || v.length() == 0)
      subject.refuse("portals", "has at ", i, " an edge of length zero: give both edges of a rectangle");
    const double cosine = u.normalized().dot(v.normalized());
    if (std::fabs(cosine) > double(kMaxCosine))
      subject.refuse("portals", "has at ", i, " edges at an angle of ", std::acos(cosine) * 180 / std::numbers::pi,
                     " degrees: give edges at right angles");
    light.portals.push_back({to_vec3(p.corner), to_vec3(p.edge_u), to_vec3(p.edge_v)});
  }
}

LightEntry read_light(bdpt_builder& builder, const bdpt_light_desc& desc) {
  const Subject subject("light", desc.label);
  subject.check_enum("type", desc.type, BDPT_LIGHT_DIRECTIONAL);
  subject.check_finite("position", desc.position, 3);
  subject.check_finite("direction", desc.direction, 3);
  subject.check_not_negative("intensity", desc.intensity, 3);
  subject.check_not_negative("radiance", desc.radiance, 3);
  subject.check_finite("cone_angle", desc.cone_angle);
  subject.check_finite("cone_falloff", desc.cone_falloff);
  subject.check_not_negative("irradiance", desc.irradiance, 3);
  subject.check_finite("angular_radius", desc.angular_radius);
  subject.check_finite("transform", desc.transform, 12);
  subject.check_finite("up", desc.up, 3);
  subject.check_reserved("reserved_2", desc.reserved_2);
  subject.check_reserved("reserved_3", desc.reserved_3);
  subject.check_range("group", desc.group, 0, 63);
  const TextureEntry* texture = nullptr;
  if (desc.texture.id != 0) {
    texture = &builder.textures.at(desc.texture.id, "desc.texture");
    if (desc.type != BDPT_LIGHT_ENVIRONMENT && desc.type != BDPT_LIGHT_SPOT)
      subject.refuse("texture", "is set: only environments and spots have a picture; set it to zero");
    if (texture->host)
      subject.refuse("texture", "is \"", texture->label(),
                     "\", which is the host's: lights are sampled by texels, so give an image");
  }
  if (desc.photometry && desc.type != BDPT_LIGHT_POINT)
    subject.refuse("photometry", "is set: only points have a measured luminaire's intensities; set it to NULL");
  LightEntry entry;
  entry.texture = desc.texture.id;
  LightDesc& light = entry.light;
  light.group = desc.group;
  light.label = subject.label();
  light.type = static_cast<LightType>(desc.type);
  light.position = to_vec3(desc.position);
  if (light.has_position()) light.intensity = to_rgb(desc.intensity);
  if (desc.type == BDPT_LIGHT_SPOT) read_spot(subject, desc, texture, light);
  if (desc.photometry) read_photometry(subject, desc, light);
  if (desc.type == BDPT_LIGHT_ENVIRONMENT) read_environment(subject, desc, texture, light);
  if (desc.type == BDPT_LIGHT_DIRECTIONAL) read_directional(subject, desc, light);
  read_portals(subject, desc, light);
  return entry;
}

void use_texture(bdpt_builder& builder, const LightEntry& light) {
  if (light.texture) ++builder.textures[light.texture].users;
}

void leave_texture(bdpt_builder& builder, const LightEntry& light) {
  if (light.texture) --builder.textures[light.texture].users;
}

}  // namespace

bdpt_result bdpt_light_add(bdpt_builder* builder, const bdpt_light_desc* desc, bdpt_light_id* light) {
  return guard(__func__, [&] {
    reset_output(light);
    bdpt_builder& b = writable(builder);
    const bdpt_light_desc d = read_struct(desc, "desc");
    require(light, "light");
    LightEntry entry = read_light(b, d);
    light->id = b.lights.add(entry);
    use_texture(b, entry);
  });
}

bdpt_result bdpt_light_update(bdpt_builder* builder, bdpt_light_id light, const bdpt_light_desc* desc) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const bdpt_light_desc d = read_struct(desc, "desc");
    LightEntry& entry = b.lights.at(light.id, "light");
    LightEntry updated = read_light(b, d);
    use_texture(b, updated);
    leave_texture(b, entry);
    entry = std::move(updated);
  });
}

bdpt_result bdpt_light_remove(bdpt_builder* builder, bdpt_light_id light) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    leave_texture(b, b.lights.at(light.id, "light"));
    b.lights.take(light.id);
  });
}
