namespace strut {}
