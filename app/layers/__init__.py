"""What the plan panes show, as plain data: one model per layer kind, made from a plan. No Qt."""
