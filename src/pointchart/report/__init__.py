"""What runs come to: a record of it, and the record as text and as JSON; computes nothing."""
