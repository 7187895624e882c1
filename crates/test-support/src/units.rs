//! A scenario in other units.

use righting_scenario::file;

/// How many new units an old one is.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// For a meter.
    pub length: f64,
    /// For a kilogram.
    pub mass: f64,
    /// For a second.
    pub time: f64,
}

impl Units {
    fn system(self, system: &mut file::System) {
        let Self { length, mass, time } = self;
        let inertia = mass * length * length;
        let scale_inertia = |rows: &mut Option<[[f64; 3]; 3]>| {
            rows.iter_mut().flatten().flatten().for_each(|entry| *entry *= inertia);
        };
        let scale_drive = |drive: &mut Option<file::Drive>| {
            if let Some(drive) = drive {
                drive.viscous_friction_n_m_s =
                    drive.viscous_friction_n_m_s.map(|friction| friction * inertia / time);
                drive.rotor_inertia_kg_m2 = drive.rotor_inertia_kg_m2.map(|rotor| rotor * inertia);
            }
        };
        let torque = inertia / time.powi(2);
        if let Some(mount) = &mut system.mount {
            mount.position_m = mount.position_m.map(|entry| entry * length);
            mount.force_max_n = mount.force_max_n.map(|force_n| force_n * torque / length);
            mount.moment_max_n_m = mount.moment_max_n_m.map(|moment_n_m| moment_n_m * torque);
        }
        let base = &mut system.base;
        base.angular_rate_max_deg_s = base.angular_rate_max_deg_s.map(|rate| rate / time);
        base.mass_kg *= mass;
        base.cube_side_m = base.cube_side_m.map(|side_m| side_m * length);
        base.keep_out_radius_m = base.keep_out_radius_m.map(|radius_m| radius_m * length);
        scale_inertia(&mut base.inertia_kg_m2);
        for shape in base.keep_out.iter_mut().flatten() {
            self.sphere(&mut shape.sphere);
            self.capsule(&mut shape.capsule);
            if let Some(cuboid) = &mut shape.cuboid {
                cuboid.center_m = cuboid.center_m.map(|entry| entry * length);
                cuboid.size_m = cuboid.size_m.map(|entry| entry * length);
            }
        }
        base.center_of_mass_m.iter_mut().flatten().for_each(|entry| *entry *= length);
        for body in system.bodies.iter_mut().flatten() {
            body.mass_kg *= mass;
            body.center_of_mass_m.iter_mut().flatten().for_each(|entry| *entry *= length);
            scale_inertia(&mut body.inertia_kg_m2);
            body.shapes.iter_mut().flatten().for_each(|shape| self.shape(shape));
            let joint = &mut body.joint;
            joint.position_m.iter_mut().flatten().for_each(|entry| *entry *= length);
            joint.rate_max_deg_s = joint.rate_max_deg_s.map(|rate| rate / time);
            joint.acceleration_max_deg_s2 =
                joint.acceleration_max_deg_s2.map(|acceleration| acceleration / time.powi(2));
            joint.jerk_max_deg_s3 =
                joint.jerk_max_deg_s3.map(|jerk_deg_s3| jerk_deg_s3 / time.powi(3));
            joint.torque_max_n_m = joint.torque_max_n_m.map(|torque_n_m| torque_n_m * torque);
            let scaled = |limit: Option<f64>, unit: f64| limit.map(|limit| limit * unit);
            joint.travel_min_m = scaled(joint.travel_min_m, length);
            joint.travel_max_m = scaled(joint.travel_max_m, length);
            joint.speed_max_m_s = scaled(joint.speed_max_m_s, length / time);
            joint.acceleration_max_m_s2 =
                scaled(joint.acceleration_max_m_s2, length / time.powi(2));
            joint.jerk_max_m_s3 = scaled(joint.jerk_max_m_s3, length / time.powi(3));
            joint.force_max_n = scaled(joint.force_max_n, torque / length);
            scale_drive(&mut joint.drive);
        }
        for link in &mut system.links {
            link.mass_kg *= mass;
            link.a_m *= length;
            link.d_m *= length;
            link.rate_max_deg_s /= time;
            link.acceleration_max_deg_s2 /= time * time;
            link.jerk_max_deg_s3 =
                link.jerk_max_deg_s3.map(|jerk_deg_s3| jerk_deg_s3 / time.powi(3));
            link.torque_max_n_m = link.torque_max_n_m.map(|torque_n_m| torque_n_m * torque);
            scale_drive(&mut link.drive);
            link.center_of_mass_m.iter_mut().flatten().for_each(|entry| *entry *= length);
            scale_inertia(&mut link.inertia_kg_m2);
            link.radius_m = link.radius_m.map(|radius_m| radius_m * length);
            link.shapes.iter_mut().flatten().for_each(|shape| self.shape(shape));
        }
        if let Some(payload) = &mut system.payload {
            payload.mass_kg *= mass;
            scale_inertia(&mut payload.inertia_kg_m2);
            payload.radius_m = payload.radius_m.map(|radius_m| radius_m * length);
            payload.shapes.iter_mut().flatten().for_each(|shape| self.shape(shape));
        }
    }

    fn shape(self, shape: &mut file::Shape) {
        self.sphere(&mut shape.sphere);
        self.capsule(&mut shape.capsule);
    }

    fn sphere(self, sphere: &mut Option<file::Sphere>) {
        if let Some(sphere) = sphere {
            sphere.center_m = sphere.center_m.map(|entry| entry * self.length);
            sphere.radius_m *= self.length;
        }
    }

    fn capsule(self, capsule: &mut Option<file::Capsule>) {
        if let Some(capsule) = capsule {
            capsule.from_m = capsule.from_m.map(|entry| entry * self.length);
            capsule.to_m = capsule.to_m.map(|entry| entry * self.length);
            capsule.radius_m *= self.length;
        }
    }

    /// The same scenario in these units, its system inline.
    pub fn of(self, file: &file::Scenario) -> file::Scenario {
        let mut file = file.clone();
        let file::SystemReference::Inline(system) = &mut file.system else { panic!("inline") };
        self.system(system);
        let initial = &mut file.initial;
        initial.angular_rate_deg_s.iter_mut().flatten().for_each(|rate| *rate /= self.time);
        initial.joint_rates_deg_s.iter_mut().flatten().for_each(|rate| *rate /= self.time);
        initial.joint_travels_m.iter_mut().for_each(|travel| *travel *= self.length);
        let speeds = initial.joint_speeds_m_s.iter_mut().flatten();
        speeds.for_each(|speed| *speed *= self.length / self.time);
        file.horizon.duration_s = file.horizon.duration_s.times(self.time);
        file.weights.control = file.weights.control.map(|weight| weight * self.time.powi(3));
        file.weights.angular_rate =
            file.weights.angular_rate.map(|weight| weight * self.time.powi(2));
        file.weights.joint_rate = file.weights.joint_rate.map(|weight| weight * self.time.powi(2));
        let clearance_m = &mut file.collision.clearance_m;
        *clearance_m = clearance_m.map(|clearance_m| clearance_m * self.length);
        file
    }
}
