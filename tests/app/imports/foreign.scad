// Bodies and hinges that nobody's export made: part is "hard" or "soft".
part = "hard";
module turned() scale(1 / 25.4) rotate([20, 35, 50]) children();  // in inches, and leaning

module window_wall() difference() {
  translate([-30, -1.5, -10]) cube([29, 3, 20]);
  translate([-24, -5, -5]) cube([14, 10, 10]);
}
module dovetail() difference() {
  translate([1, -5, -10]) cube([20, 10, 20]);
  translate([8, 0, -11]) linear_extrude(22) polygon([[0, 6], [-3, 0], [9, 0], [6, 6]]);
}
module rod() {
  translate([-36, 0, -10]) cylinder(r = 1.5, h = 20, $fn = 32);
  for (z = [-10, 7]) translate([-37, -1.5, z]) cube([7.5, 3, 3]);
}
module c_knuckle() difference() {
  union() {
    translate([-36, 0, -5]) cylinder(r = 3.2, h = 10, $fn = 48);
    translate([-52, -1.2, -5]) cube([14, 2.4, 10]);
  }
  translate([-36, 0, -6]) cylinder(r = 1.75, h = 12, $fn = 48);
  translate([-36, 0, -6]) linear_extrude(12) polygon([[0, 0], [8, -7], [8, 7]]);
}
module hollow() translate([34, 0, 0]) rotate([0, 90, 0]) difference() {
  cylinder(r = 6, h = 15, $fn = 64);
  translate([0, 0, 3]) cylinder(r = 4.5, h = 20, $fn = 64);
}
module soft() {
  translate([-1, -0.75, -8]) cube([2, 1.5, 16]);
  translate([21, -5, -0.6]) cube([13, 10, 1.2]);
}

turned() if (part == "soft") soft();
else {
  union() { window_wall(); rod(); }
  dovetail();
  c_knuckle();
  hollow();
}
