// The names of an SDF file's elements, by what they stand in.
#pragma once

#include <algorithm>
#include <string_view>

namespace forage::bug {

/// After a name: s text, b truth, 1 number, i whole number, 2 and 3 numbers, c colour, p pose, * anything.
struct Rule {
    std::string_view parent, children;
};

// A name means the same wherever it stands, as far as readers are concerned: <range> of a light is a number,
// that of a scanner has children. Sorted by parent.
inline constexpr Rule rules[] = {
    {"accel", "bias_mean:1 bias_stddev:1 mean:1 stddev:1"},
    {"actor", "animation frame joint link plugin:* pose:p script skin static:b"},
    {"air_pressure", "pressure reference_altitude:1"},
    {"altimeter", "vertical_position vertical_velocity"},
    {"angular_velocity", "x y z"},
    {"animation", "filename:s interpolate_x:b scale:1"},
    {"atmosphere", "pressure:1 temperature:1 temperature_gradient:1"},
    {"attenuation", "constant:1 linear:1 quadratic:1 range:1"},
    {"audio", "device:s"},
    {"audio_source", "contact frame gain:1 loop:b pitch:1 pose:p uri:s"},
    {"axis", "dynamics initial_position:1 limit use_parent_model_frame:b xyz:3"},
    {"axis2", "dynamics initial_position:1 limit use_parent_model_frame:b xyz:3"},
    {"battery", "voltage:1"},
    {"blend", "fade_dist:1 min_height:1"},
    {"bounce", "restitution_coefficient:1 threshold:1"},
    {"box", "size:3"},
    {"bullet",
     "constraints dt:1 fdir1:3 friction:1 friction2:1 kd:1 kp:1 rolling_friction:1 soft_cfm:1 "
     "soft_erp:1 solver split_impulse:b split_impulse_penetration_threshold:1"},
    {"camera",
     "box_type:s clip depth_camera distortion frame horizontal_fov:1 image lens noise pose:p "
     "projection_type:s save segmentation_type:s track_visual view_controller:s visibility_mask:i"},
    {"capsule", "length:1 radius:1"},
    {"clip", "far:1 near:1"},
    {"clouds", "ambient:c direction:1 humidity:1 mean_size:1 speed:1"},
    {"collision", "frame geometry laser_retro:1 max_contacts:i pose:p surface"},
    {"constraints",
     "cfm:1 contact_max_correcting_vel:1 contact_surface_layer:1 erp:1 split_impulse:b "
     "split_impulse_penetration_threshold:1"},
    {"contact",
     "bullet category_bitmask:i collide_bitmask:i collide_without_contact:b "
     "collide_without_contact_bitmask:i collision:s dissipation:1 dynamic_friction:1 elastic_modulus:1 ode "
     "override_impact_capture_velocity:1 override_stiction_transition_velocity:1 plastic_coef_restitution:1 "
     "plastic_impact_velocity:1 poissons_ratio:1 static_friction:1 stiffness:1 topic:s viscous_friction:1"},
    {"custom_function", "c1:1 c2:1 c3:1 f:1 fun:s"},
    {"cylinder", "length:1 radius:1"},
    {"dart", "bone_attachment:1 collision_detector:s damping:1 flesh_mass_fraction:1 solver stiffness:1"},
    {"depth_camera", "clip output:s"},
    {"distortion", "center:2 k1:1 k2:1 k3:1 p1:1 p2:1"},
    {"distribution", "cols:i rows:i step:3 type:s"},
    {"dynamics", "damping:1 friction:1 spring_reference:1 spring_stiffness:1"},
    {"ellipsoid", "radii:3"},
    {"fog", "color:c density:1 end:1 start:1 type:s"},
    {"force", "x y z"},
    {"force_torque", "force frame:s measure_direction:s torque"},
    {"frame", "pose:p"},
    {"friction", "bullet ode torsional"},
    {"geometry", "box capsule cylinder ellipsoid empty heightmap image mesh plane polyline sphere"},
    {"gps", "position_sensing velocity_sensing"},
    {"grasp_check", "attach_steps:i detach_steps:i min_contact_count:i"},
    {"gripper", "grasp_check gripper_link:s palm_link:s"},
    {"gui", "camera plugin:*"},
    {"heightmap", "blend pos:3 sampling:i size:3 texture uri:s use_terrain_paging:b"},
    {"horizontal", "max_angle:1 min_angle:1 noise resolution:1 samples:i"},
    {"image", "format:s granularity:i height:i scale:1 threshold:i uri:s width:i"},
    {"imu",
     "angular_velocity enable_orientation:b linear_acceleration noise orientation_reference_frame "
     "topic:s"},
    {"include", "name:s placement_frame:s plugin:* pose:p static:b uri:s"},
    {"inertia", "ixx:1 ixy:1 ixz:1 iyy:1 iyz:1 izz:1"},
    {"inertial", "frame inertia mass:1 pose:p"},
    {"intrinsics", "cx:1 cy:1 fx:1 fy:1 s:1"},
    {"joint",
     "axis axis2 child:s frame gearbox_ratio:1 gearbox_reference_body:s parent:s physics pose:p "
     "sensor thread_pitch:1"},
    {"lens", "custom_function cutoff_angle:1 env_texture_size:i intrinsics scale_to_hfov:b type:s"},
    {"lidar", "noise range scan"},
    {"light", "attenuation cast_shadows:b diffuse:c direction:3 frame intensity:1 pose:p specular:c spot"},
    {"limit", "cfm:1 dissipation:1 effort:1 erp:1 lower:1 stiffness:1 upper:1 velocity:1"},
    {"linear_acceleration", "x y z"},
    {"link",
     "audio_sink audio_source battery collision enable_wind:b frame gravity:b inertial kinematic:b "
     "light must_be_base_link:b particle_emitter pose:p projector self_collide:b sensor velocity_decay "
     "visual"},
    {"logical_camera", "aspect_ratio:1 far:1 horizontal_fov:1 near:1"},
    {"magnetometer", "x y z"},
    {"material",
     "ambient:c diffuse:c double_sided:b emissive:c lighting:b pbr render_order:1 script shader "
     "specular:c"},
    {"mesh", "scale:3 submesh uri:s"},
    {"meta", "layer:i"},
    {"metal",
     "albedo_map:s ambient_occlusion_map:s emissive_map:s environment_map:s light_map:s metalness:s "
     "metalness_map:s normal_map:s roughness:s roughness_map:s"},
    {"model",
     "allow_auto_disable:b enable_wind:b frame gripper include joint link model plugin:* pose:p "
     "self_collide:b static:b"},
    {"noise",
     "accel bias_mean:1 bias_stddev:1 dynamic_bias_correlation_time:1 dynamic_bias_stddev:1 mean:1 "
     "precision:1 rate stddev:1 type:s"},
    {"ode",
     "bounce:1 cfm:1 cfm_damping:b constraints erp:1 fdir1:3 fudge_factor:1 implicit_spring_damper:b "
     "kd:1 kp:1 limit max_force:1 max_vel:1 min_depth:1 mu:1 mu2:1 provide_feedback:b slip:1 slip1:1 slip2:1 "
     "soft_cfm:1 soft_erp:1 solver suspension velocity:1"},
    {"orientation_reference_frame", "custom_rpy:3 grav_dir_x:3 localization:s"},
    {"particle_emitter",
     "color_end:c color_range_image:s color_start:c duration:1 emitting:b lifetime:1 "
     "material max_velocity:1 min_velocity:1 particle_scatter_ratio:1 particle_size:3 pose:p rate:1 "
     "scale_rate:1 size:3 topic:s"},
    {"pbr", "metal specular"},
    {"physics",
     "bullet dart gravity:3 magnetic_field:3 max_contacts:i max_step_size:1 ode "
     "provide_feedback:b real_time_factor:1 real_time_update_rate:1 simbody update_rate:1"},
    {"plane", "normal:3 size:2"},
    {"polyline", "height:1 point:2"},
    {"population", "box cylinder distribution frame model model_count:i pose:p"},
    {"position_sensing", "horizontal vertical"},
    {"pressure", "noise"},
    {"projector", "far_clip:1 fov:1 frame near_clip:1 plugin:* pose:p texture:s"},
    {"range", "max:1 min:1 resolution:1"},
    {"rate", "bias_mean:1 bias_stddev:1 mean:1 stddev:1"},
    {"ray", "noise range scan"},
    {"road", "material point:3 width:1"},
    {"save", "path:s"},
    {"scan", "horizontal vertical"},
    {"scene", "ambient:c background:c fog grid:b origin_visual:b shadows:b sky"},
    {"script", "auto_start:b delay_start:1 loop:b name:s trajectory uri:s"},
    {"sdf", "actor light model world"},
    {"sensor",
     "air_pressure altimeter always_on:b camera contact enable_metrics:b force_torque frame gps "
     "imu lidar logical_camera magnetometer navsat:* plugin:* pose:p ray rfid rfidtag sonar topic:s "
     "transceiver update_rate:1 visualize:b"},
    {"shader", "normal_map:s"},
    {"simbody", "accuracy:1 contact max_transient_velocity:1 min_step_size:1 must_be_loop_joint:b"},
    {"skin", "filename:s scale:1"},
    {"sky", "clouds sunrise:1 sunset:1 time:1"},
    {"soft_contact", "dart"},
    {"solver",
     "dt:1 friction_model:s island_threads:i iters:i min_step_size:1 precon_iters:i solver_type:s "
     "sor:1 thread_position_correction:b type:s use_dynamic_moi_rescaling:b"},
    {"sonar", "geometry:s max:1 min:1 radius:1"},
    {"specular",
     "albedo_map:s ambient_occlusion_map:s emissive_map:s environment_map:s glossiness:s "
     "glossiness_map:s light_map:s normal_map:s specular_map:s"},
    {"sphere", "radius:1"},
    {"spherical_coordinates",
     "elevation:1 heading_deg:1 latitude_deg:1 longitude_deg:1 surface_model:s "
     "world_frame_orientation:s"},
    {"spot", "falloff:1 inner_angle:1 outer_angle:1"},
    {"submesh", "center:b name:s"},
    {"surface", "bounce contact friction soft_contact"},
    {"suspension", "cfm:1 erp:1"},
    {"texture", "diffuse:s normal:s size:1"},
    {"torque", "x y z"},
    {"torsional", "coefficient:1 ode patch_radius:1 surface_radius:1 use_patch_radius:b"},
    {"track_visual", "inherit_yaw:b max_dist:1 min_dist:1 name:s static:b use_model_frame:b xyz:3"},
    {"trajectory", "waypoint"},
    {"transceiver", "essid:s frequency:1 gain:1 max_frequency:1 min_frequency:1 power:1 sensitivity:1"},
    {"velocity_decay", "angular:1 linear:1"},
    {"velocity_sensing", "horizontal vertical"},
    {"vertical", "max_angle:1 min_angle:1 noise resolution:1 samples:i"},
    {"vertical_position", "noise"},
    {"vertical_velocity", "noise"},
    {"visual",
     "cast_shadows:b frame geometry laser_retro:1 material meta plugin:* pose:p transparency:1 "
     "visibility_flags:i"},
    {"waypoint", "pose:p time:1"},
    {"wind", "linear_velocity:3"},
    {"world",
     "actor atmosphere audio frame gravity:3 gui include light magnetic_field:3 model physics "
     "plugin:* population road scene spherical_coordinates state:* wind"},
    {"x", "noise"},
    {"y", "noise"},
    {"z", "noise"},
};
static_assert(std::ranges::is_sorted(rules, {}, &Rule::parent));

}  // namespace forage::bug
