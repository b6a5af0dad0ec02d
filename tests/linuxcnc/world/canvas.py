"""What a screen's preview draws on, here one that only counts."""


class Canvas:
    parameter_file, moves = "mill.var", 0

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *words: None

    def straight_feed(self, *place):
        self.moves += 1

    straight_traverse = straight_feed

    def get_external_length_units(self):
        return 1.0

    get_external_angular_units = get_external_angle_units = get_external_length_units

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return False

    check_abort = is_lathe = get_block_delete

    def get_tool(self, pocket):
        return (-1,) + (0.0,) * 12 + (0,)
