import { mount } from 'svelte';
import './app.css';
import App from './App.svelte';
import { start } from './studio';
import { frame } from './stores/frame.svelte';
import { theme } from './stores/theme.svelte';

theme.start();
frame.start();
mount(App, { target: document.getElementById('app')! });
start();
